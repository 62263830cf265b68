// frictab init DIR: a documented job file to start from.
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/command.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "job/schema.h"

namespace frictab::cli::init_command {

namespace {

namespace fs = std::filesystem;

void write_job(const fs::path& directory, bool force) {
  const fs::path file = directory / "job.toml";
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_directory(directory, error))
    throw InputError({directory.string(), 0, 0}, "is a file, a directory is needed",
                     "name another directory");
  if (fs::exists(file, error) && !force)
    throw InputError({file.string(), 0, 0}, "is there already",
                     "name another directory, or --force to replace it");
  io::OutputFiles files(directory);
  files.write("job.toml", job::job_template());
  files.commit();
}

int run(const std::string& directory, const CommonOptions& common) {
  write_job(directory, common.force);
  const std::string file = (fs::path(directory) / "job.toml").string();
  fmt::print("{}\n", file);
  note(common, fmt::format("next: put the tribometer data beside it, set data.training, then: "
                           "frictab run {}\n(no data yet? frictab twin DIR makes a synthetic "
                           "campaign)",
                           file));
  return 0;
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  auto directory = std::make_shared<std::string>();
  app.add_option("DIR", *directory, "directory of the new job")->required();
  return [directory, &common] { return run(*directory, common); };
}

const Registered<Command> registered{[] {
  return Command{"init", 10, "Write a documented job file to start from", declare};
}};

} // namespace

} // namespace frictab::cli::init_command
