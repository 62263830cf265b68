// frictab init DIR: a documented job file to start from; --from FILES: one made from the files.
#include <algorithm>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/command.h"
#include "core/error.h"
#include "data/file_list.h"
#include "io/atomic_file.h"
#include "job/guessed_job.h"
#include "job/schema.h"

namespace frictab::cli::init_command {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string directory;
  std::vector<std::string> from;
};

void write_job(const fs::path& directory, bool force, const std::string& text) {
  const fs::path file = directory / "job.toml";
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_directory(directory, error))
    throw InputError({directory.string(), 0, 0}, "is a file, a directory is needed",
                     "name another directory");
  if (fs::exists(file, error) && !force)
    throw InputError({file.string(), 0, 0}, "is there already",
                     "name another directory, or --force to replace it");
  io::OutputFiles files(directory);
  files.write("job.toml", text);
  files.commit();
}

int init_empty(const Options& options, const CommonOptions& common) {
  if (options.directory.empty())
    throw InputError({}, "where to? No directory is given",
                     "frictab init DIR, or frictab init --from FILES");
  write_job(options.directory, common.force, job::job_template());
  const std::string file = (fs::path(options.directory) / "job.toml").string();
  fmt::print("{}\n", file);
  note(common, fmt::format("next: put the tribometer data beside it, set data.training, then: "
                           "frictab run {}\n(no data yet? frictab twin DIR makes a synthetic "
                           "campaign; data files there? frictab init DIR --from FILES)",
                           file));
  return 0;
}

// Names as the job file's directory sees them: one glob where it finds these files and no others.
std::vector<std::string> training_names(const std::vector<std::string>& files,
                                        const std::string& directory) {
  const fs::path first = files.front();
  const std::string any = "*" + first.extension().string();
  std::vector<std::string> sorted = files;
  std::sort(sorted.begin(), sorted.end());
  const auto finds_them = [&](const std::string& glob) {
    try {
      return data::find_files({glob}, directory, {}) == sorted;
    } catch (const InputError&) { // none
      return false;
    }
  };
  for (const fs::path& glob :
       {first.parent_path() / any, first.parent_path().parent_path() / "*" / any})
    if (files.size() > 1 && finds_them(glob.string())) return {glob.string()};
  return files;
}

int init_from(const Options& options, const CommonOptions& common) {
  const std::string directory = options.directory.empty() ? "." : options.directory;
  std::vector<std::string> files;
  for (const std::string& file : data::find_files(options.from, "", {{}, 0, 0}))
    files.push_back(fs::relative(file, directory).string());
  std::vector<data::GuessedFile> guesses;
  for (const std::string& file : files)
    guesses.push_back(data::guess_file((fs::path(directory) / file).string(), file));
  const job::GuessedJob guessed =
      job::guessed_job(guesses, data::guess_names(files), training_names(files, directory));
  write_job(directory, common.force, guessed.text);
  const std::string file = (fs::path(directory) / "job.toml").lexically_normal().string();
  fmt::print("{}\n", file);
  for (const std::string& question : guessed.questions)
    note(common, "to be answered in it: " + question);
  note(common, fmt::format("next: frictab data {0} (shows what is read), frictab run {0}", file));
  return 0;
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  auto options = std::make_shared<Options>();
  app.add_option("DIR", options->directory, "directory of the new job");
  app.add_option("--from", options->from,
                 "data files, folders or names with *: the job is made from what they hold")
      ->expected(1, -1);
  return [options, &common] {
    return options->from.empty() ? init_empty(*options, common) : init_from(*options, common);
  };
}

const Registered<Command> registered{[] {
  return Command{"init", 10, "Write a job file: with every key, or made --from data files",
                 declare};
}};

} // namespace

} // namespace frictab::cli::init_command
