// frictab init DIR: a documented job file to start from; --from FILES: one made for these files.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/print.h"
#include "core/error.h"
#include "core/os/files.h"
#include "core/text.h"
#include "data/file_list.h"
#include "io/atomic_file.h"
#include "job/answers.h"
#include "job/guessed_job.h"
#include "job/schema.h"

namespace frictab::cli::init_command {

namespace fs = std::filesystem;

struct Options {
  std::string directory;
  std::vector<std::string> from;
  std::vector<std::string> sheets;
  bool interactive = false;
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
  io::OutputFiles files(directory, io::OutputFiles::Claim::one_file);
  files.write("job.toml", text);
  files.commit();
}

int init_empty(const Options& options, const CommonOptions& common) {
  if (options.interactive)
    throw InputError({}, "--interactive has no files to ask about",
                     "frictab init DIR --interactive --from FILES");
  if (options.directory.empty())
    throw InputError({}, "where to? No directory is given",
                     "frictab init DIR, or frictab init --from FILES");
  write_job(options.directory, common.force, job::job_template());
  const std::string file = (fs::path(options.directory) / "job.toml").string();
  print_out("{}\n", file);
  note(common, fmt::format("next: put the tribometer data next to it, set data.training, then: "
                           "frictab run {}\n(no data yet? frictab twin DIR makes a synthetic "
                           "campaign; data files there? frictab init DIR --from FILES)",
                           file));
  return 0;
}

// Path relative to the job file's directory, which need not exist yet.
std::string relative_to(const fs::path& file, const std::string& directory) {
  return fs::relative(fs::absolute(file), fs::absolute(directory)).string();
}

// Whether these globs find these files and no others.
bool find_exactly(const std::vector<std::string>& globs, std::vector<std::string> files) {
  std::ranges::sort(files);
  try {
    std::vector<std::string> found = data::find_files(globs, "", {});
    std::ranges::sort(found);
    return found == files;
  } catch (const InputError&) { // no match
    return false;
  }
}

// Returns one glob, or one per folder, if these match the files and no others; else the files. No
// glob matches files that a run writes below the job file's directory.
std::vector<std::string> training_names(const std::vector<std::string>& files,
                                        const std::string& directory) {
  const std::string any = "*" + fs::path(files.front()).extension().string();
  std::vector<std::string> folders;
  for (const std::string& file : files)
    if (const std::string glob = (fs::path(file).parent_path() / any).string();
        std::ranges::find(folders, glob) == folders.end())
      folders.push_back(glob);
  const fs::path above = fs::path(folders.front()).parent_path().parent_path();
  const std::string of_all = (above / "*" / any).string();
  std::vector<std::string> names = files;
  if (files.size() > folders.size() && find_exactly(folders, files)) names = folders;
  if (folders.size() > 1 && find_exactly({of_all}, files) &&
      relative_to(of_all, directory) != (fs::path("*") / any).string())
    names = {of_all};
  for (std::string& name : names)
    name = relative_to(name, directory);
  return names;
}

// Guesses of all files; of several, those without a table are passed over, with a line each in
// `passed`.
std::vector<guess::File> guesses_of(const std::vector<std::string>& files,
                                    std::vector<std::string>& passed) {
  std::vector<guess::File> guesses;
  std::optional<InputError> first;
  for (const std::string& file : files)
    try {
      for (guess::File& guess : guess::guess_file(file, file))
        guesses.push_back(std::move(guess));
    } catch (const InputError& error) {
      if (!fs::exists(file)) throw;
      if (!first) first = error;
      passed.push_back("not read: " + format_place(error.faults().front().place) + ": " +
                       error.faults().front().what);
    }
  if (guesses.empty()) throw InputError(*first);
  return guesses;
}

// Whether names of files and folders contain this folder, or a file in it.
bool is_named(const fs::path& folder, const std::vector<std::string>& names) {
  return std::ranges::any_of(names, [&](const std::string& name) {
    const fs::path one = fs::path(name).lexically_normal();
    return (one / "").lexically_normal() == (folder / "").lexically_normal() ||
           one.parent_path() == folder;
  });
}

// Adds a line for folders inside the ones to read, unless a run of frictab wrote them.
void add_folders_not_looked_into(const std::vector<std::string>& from,
                                 std::vector<std::string>& passed) {
  constexpr std::size_t most = 8;
  std::vector<std::string> found, counted;
  const auto files_of = [](const fs::path& folder) {
    std::size_t files = 0;
    bool is_of_run = false;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(
             folder, fs::directory_options::skip_permission_denied, error)) {
      files += entry.is_regular_file(error) && !entry.path().filename().string().starts_with('.');
      is_of_run = is_of_run || entry.path().filename() == "stages.json";
    }
    return is_of_run ? 0 : files;
  };
  for (const std::string& folder : from) {
    std::error_code error;
    std::set<fs::path> inside;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
      if (entry.is_directory(error) && !entry.path().filename().string().starts_with('.'))
        inside.insert(entry.path().lexically_normal());
    for (const fs::path& one : inside)
      if (const std::size_t files = files_of(one); files > 0 && !is_named(one, from)) {
        found.push_back(one.string());
        counted.push_back(
            fmt::format("{} ({} file{})", one.string(), files, files == 1 ? "" : "s"));
      }
  }
  if (found.empty()) return;
  if (found.size() > most) counted.resize(most);
  passed.push_back(fmt::format(
      "not looked into: {}{}; if they have data, name them too: frictab init --force --from {} {}",
      join(counted, ", "), found.size() > most ? ", ..." : "", join(from, " "),
      found.size() > most ? "FOLDER" : join(found, " ")));
}

// Keeps the sheets of these names, or like them with *; tables of tests in other workbooks stay.
void keep_sheets(std::vector<guess::File>& guesses, const std::vector<std::string>& sheets) {
  std::vector<std::string> names;
  for (const guess::File& guess : guesses)
    if (!guess.sheet.empty()) names.push_back(guess.sheet);
  const auto is_meant = [](const std::string& name, const std::string& sheet) {
    return name == sheet || os::is_like(name, sheet);
  };
  for (const std::string& sheet : sheets)
    if (std::ranges::none_of(names, [&](const std::string& name) { return is_meant(name, sheet); }))
      throw InputError({}, fmt::format("no workbook has a table in a sheet '{}'", sheet),
                       suggest(sheet, names));
  std::erase_if(guesses, [&](const guess::File& guess) {
    return !sheets.empty() && !guess.sheet.empty() &&
           std::ranges::none_of(
               sheets, [&](const std::string& sheet) { return is_meant(guess.sheet, sheet); });
  });
}

// Shows a question and reads its answer from standard input.
std::optional<std::string> next_answer(const std::string& lines) {
  print_error("{}", lines);
  std::string answer;
  if (std::getline(std::cin, answer)) return answer;
  print_error("\n");
  return std::nullopt;
}

// Makes a job in DIR for the files; messages call them as the user does.
job::GuessedJob guess_from(const Options& options, const std::vector<std::string>& files,
                           const std::string& directory, std::vector<std::string>& passed) {
  std::vector<guess::File> guesses = guesses_of(files, passed);
  keep_sheets(guesses, options.sheets);
  guess::Campaign campaign = guess::sort_guesses(std::move(guesses));
  if (!options.sheets.empty()) campaign.sheets = options.sheets;
  if (options.interactive) campaign = job::with_answers(std::move(campaign), next_answer);
  std::vector<std::string> of_rows, names;
  for (guess::File& guess : campaign.files) {
    if (of_rows.empty() || of_rows.back() != guess.file) of_rows.push_back(guess.file);
    guess.file = relative_to(guess.file, directory);
    names.push_back(guess.sheet.empty() ? guess.file : guess.file + "/" + guess.sheet);
  }
  if (campaign.tests) campaign.tests->file = relative_to(campaign.tests->file, directory);
  for (guess::LeftFile& left : campaign.left)
    left.file = relative_to(left.file, directory);
  return job::guessed_job(campaign, guess::guess_names(names), training_names(of_rows, directory));
}

int init_from(const Options& options, const CommonOptions& common) {
  const std::string directory = options.directory.empty() ? "." : options.directory;
  std::vector<std::string> files;
  for (const std::string& file : data::find_files(options.from, "", {{}, 0, 0}))
    files.push_back(fs::path(file).lexically_normal().string());
  std::vector<std::string> passed;
  const job::GuessedJob guessed = guess_from(options, files, directory, passed);
  for (const std::string& left : guessed.left)
    passed.push_back("not read: " + left);
  add_folders_not_looked_into(options.from, passed);
  write_job(directory, common.force, guessed.text);
  const std::string file = (fs::path(directory) / "job.toml").lexically_normal().string();
  print_out("{}\n", file);
  std::fflush(stdout); // stdout before the lines to stderr
  for (const std::string& line : passed)
    note(common, line);
  for (const std::string& question : guessed.questions)
    note(common, "open question in " + file + ": " + question);
  note(common, fmt::format("next: frictab data {0} (shows what is read), frictab run {0}", file));
  return 0;
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  auto options = std::make_shared<Options>();
  app.add_option("DIR", options->directory, "directory of the new job");
  app.add_option("--from", options->from,
                 "data files, folders or names with *: the job is made from what they hold")
      ->type_name("FILES")
      ->expected(1, -1);
  app.add_option("--sheet", options->sheets,
                 "the sheet of a workbook with the rows, or several; names with *")
      ->type_name("NAME")
      ->expected(1, -1);
  app.add_flag("--interactive", options->interactive,
               "ask, line by line, for what the files leave open");
  return [options, &common] {
    return options->from.empty() ? init_empty(*options, common) : init_from(*options, common);
  };
}

const Registered<Command> registered{[] {
  return Command{"init",
                 10,
                 "Write a job file: with every key, or made --from data files",
                 declare,
                 uses_force | uses_quiet,
                 {{"frictab init my_job", "my_job/job.toml with every key and its default"},
                  {"frictab init guessed --from data/*.csv", "a job guessed from data files"}}};
}};

} // namespace frictab::cli::init_command
