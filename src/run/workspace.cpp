// Keeps the staged files, the record of stages and the checkpoint consistent.
#include "run/workspace.h"

#include <fmt/format.h>

#include "core/error.h"
#include "run/results.h"

namespace frictab::run {

namespace fs = std::filesystem;

Workspace::Workspace(const job::Job& job)
    : job_(job), output_(job.directory), earlier_(job), record_(job, job.directory) {
  check_directory(job_, record_);
}

void Workspace::check_fresh(const Stage& stage, const std::string& data) const {
  const std::string why = record_.stale(stage.name, data);
  if (why.empty()) return;
  const fs::path named = fs::path(job_.directory) / stage.folder_or_file();
  throw InputError({named.string(), 0, 0}, "is stale: " + why,
                   fmt::format("`frictab {} {}` rebuilds it, `frictab run` everything; `frictab "
                               "status` shows all stages",
                               stage.name, job_.arguments()));
}

void Workspace::check_as_written(std::string_view stage, const std::string& path) const {
  if (record_.is_as_written(path).value_or(true)) return;
  throw InputError({(fs::path(job_.directory) / path).string(), 0, 0},
                   fmt::format("was changed since `frictab {}` wrote it", stage),
                   fmt::format("`frictab {} {}` rebuilds it; for a law with constants of your own "
                               "or a table from elsewhere: `frictab export --law` or `--table`",
                               stage, job_.arguments()));
}

void Workspace::remove_earlier(const std::vector<std::string>& called_like_results,
                               std::string_view folder) {
  for (const std::string& file : called_like_results)
    output_.remove_old(file);
  for (const std::string& file : record_.recorded_in(folder))
    output_.remove_old(file);
}

void Workspace::commit() {
  commit_results(job_, record_, output_);
}

void Workspace::save_checkpoint() {
  if (!checkpoint_) return;
  record_files(record_, output_);
  output_.keep("stages.json", record_.json());
  has_saved_ = true;
}

std::string Workspace::checkpoint_text() const {
  if (!has_saved_) return "";
  return fmt::format("what was finished is kept in {}; `frictab run {}` goes on from there",
                     (fs::path(job_.directory) / io::kept_name).string(), job_.arguments());
}

} // namespace frictab::run
