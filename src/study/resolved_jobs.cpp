// Resolves jobs, and hashes everything they depend on except the campaign's own data.
#include "study/resolved_jobs.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/hash.h"
#include "data/file_list.h"
#include "io/file_streams.h"
#include "job/toml_tree.h"
#include "study/toml_values.h"

namespace frictab::study {

namespace fs = std::filesystem;
using job::TomlNode;

namespace {

// Placeholder for the campaign's files while the job is checked.
constexpr const char* some_data = "data.training=\"-\"";

void erase_keys(TomlNode* table, const std::vector<std::string>& names) {
  if (!table) return;
  std::erase_if(table->items, [&](const TomlNode& item) {
    return std::ranges::find(names, item.key) != names.end();
  });
}

// Rejects overrides of files: a campaign gives its own, so that such an override would have no
// effect.
void check_overrides(const std::vector<std::string>& set, FaultList& faults) {
  for (std::size_t i = 0; i < set.size(); ++i)
    for (const char* key : {"data.training", "data.validation", "data.oracle", "output.directory"})
      if (set[i].substr(0, set[i].find_first_of(" =")) == key)
        faults.add({fmt::format("--set {}", i + 1), 0, 0},
                   fmt::format("a study does not take {}", key),
                   "files stand in campaigns, the directory in study.toml");
}

// Returns the job's text without the paths of files, whose contents are hashed instead.
std::string words_of(std::string_view text, const std::string& file,
                     const std::vector<std::string>& set) {
  TomlNode root = job::parse_toml(text, file);
  for (std::size_t i = 0; i < set.size(); ++i)
    job::apply_override(root, set[i], i + 1);
  erase_keys(&root, {"output"});
  if (TomlNode* const data = root.find("data")) {
    erase_keys(data, {"training", "validation", "oracle", "tests"});
    erase_keys(data->find("join"), {"files"});
  }
  if (TomlNode* const models = root.find("models")) {
    erase_keys(models, {"files"});
    for (TomlNode& law : models->items)
      erase_keys(&law, {"table"});
  }
  return job::canonical_text(root);
}

// Files that all campaigns share: tests, a second clock, laws.
std::vector<std::string> shared_files(const job::Job& job) {
  const data::DataOptions& data = job.data;
  std::vector<std::string> files;
  const auto add = [&](const std::vector<std::string>& named, const Place& place) {
    for (std::string& file : data::find_files(named, data.base, place))
      files.push_back(std::move(file));
  };
  if (!data.tests.empty()) files.push_back(data.tests);
  add(data.join.files, data.join.place);
  add(job.models.files, job.models.place);
  for (const models::LawText& law : job.models.texts)
    if (!law.table.empty()) files.push_back(law.table);
  return files;
}

std::string fingerprint_of(const job::Job& job, const std::string& words, WatchedFiles& shared) {
  std::string text = words;
  for (const std::string& file : shared_files(job))
    text += fmt::format("\n{} {}", fs::path(file).filename().string(),
                        hash_text(shared.add(fs::path(job.data.base) / file, file)));
  return hash_text(hash_of(text));
}

} // namespace

ResolvedJobs::ResolvedJobs(std::string file, std::vector<std::string> set)
    : file_(std::move(file)), text_(io::read_file(file_)),
      folder_(fs::path(file_).parent_path().string()), set_(std::move(set)) {
  jobs_.push_back(resolve({}));
  known_[{}] = 0;
}

ResolvedJob ResolvedJobs::resolve(const std::vector<std::string>& set) const {
  std::vector<std::string> all = set;
  all.insert(all.end(), set_.begin(), set_.end());
  FaultList faults;
  check_overrides(all, faults);
  std::vector<std::string> with_data = all;
  with_data.emplace_back(some_data);
  ResolvedJob resolved;
  try {
    resolved.job = job::parse_job(text_, file_, with_data);
  } catch (const InputError& error) {
    faults.add(error);
  }
  faults.throw_if_any();
  data::DataOptions& data = resolved.job.data;
  data.training.clear();
  data.validation.clear();
  data.oracle.clear();
  resolved.fingerprint = fingerprint_of(resolved.job, words_of(text_, file_, all), resolved.shared);
  return resolved;
}

std::size_t ResolvedJobs::find(const std::vector<std::string>& set, const Place& place,
                               FaultList& faults) {
  const auto [at, is_new] = known_.try_emplace(set, jobs_.size());
  if (!is_new) return at->second;
  try {
    jobs_.push_back(resolve(set));
  } catch (const InputError& error) {
    at->second = 0;
    add_at(place, error, faults);
  }
  return at->second;
}

} // namespace frictab::study
