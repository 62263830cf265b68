// Publishes directories by rename.
#include "study/result_store.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fmt/format.h>

#include "core/error.h"
#include "core/hash.h"
#include "core/os/files.h"
#include "io/atomic_file.h"
#include "io/directory_lock.h"
#include "io/file_streams.h"
#include "io/json.h"
#include "io/json_fields.h"
#include "run/stage_record.h"
#include "study/keys.h"

namespace frictab::study {

namespace fs = std::filesystem;

constexpr const char* failure_schema = "frictab/study-failure/1";

static void describe(io::Fields& f, Failure& failure) {
  f("campaign", failure.campaign);
  f("by_input", failure.by_input);
  f("message", failure.message);
}

fs::path result_directory(const std::string& directory, std::uint64_t key) {
  return fs::path(directory) / results_folder / key_text(key);
}

CampaignResult read_result(const std::string& directory, std::uint64_t key) {
  const fs::path file = result_directory(directory, key) / result_file;
  const std::string text = io::read_file(file);
  if (const std::string damage = damage_of_result(text, key_text(key)); !damage.empty())
    throw InputError({file.string(), 0, 0}, damage, "`frictab study run` makes it again");
  return parse_result(text, file.string());
}

std::vector<std::string> differences_of_result(const std::string& directory, std::uint64_t key) {
  const fs::path folder = result_directory(directory, key), stages = folder / "stages.json";
  try {
    const CampaignResult result = read_result(directory, key);
    if (hash_text(io::hash_of_file(stages, stages.string())) != result.stages_hash)
      return {"stages.json was changed"};
    return run::differences_in(folder);
  } catch (const InputError& error) {
    const Fault& fault = error.faults().front();
    return {fs::path(fault.place.file).filename().string() + ": " + fault.what};
  }
}

fs::path failure_path(const std::string& directory, std::uint64_t key) {
  return fs::path(directory) / failures_folder / (key_text(key) + ".json");
}

void write_failure(const std::string& directory, std::uint64_t key, const Failure& failure) {
  const fs::path file = failure_path(directory, key);
  io::OutputFiles output(file.parent_path(), io::OutputFiles::Claim::one_file);
  output.write(file.filename().string(),
               io::sealed(io::record_text(failure_schema, [&](io::Fields& f) {
                 f.only_written("key", key_text(key));
                 describe(f, io::to_write(failure));
               })));
  output.commit();
}

Failure read_failure(const std::string& directory, std::uint64_t key) {
  const std::string file = failure_path(directory, key).string(), text = io::read_file(file);
  const std::string mends = "remove it: `frictab study run` tries the campaign again";
  if (io::seal_of(text) == io::Seal::broken)
    throw InputError({file, 0, 0}, "its hash does not fit", mends);
  Failure failure;
  io::read_record(text, file, failure_schema, mends, [&](io::Fields& f) { describe(f, failure); });
  return failure;
}

static bool is_damaged(const std::string& directory, std::uint64_t key) {
  return fs::exists(result_directory(directory, key)) &&
         !differences_of_result(directory, key).empty();
}

WorkDirectory::WorkDirectory(const std::string& directory, std::uint64_t key)
    : directory_(directory), key_(key), final_(result_directory(directory, key)) {
  std::error_code error;
  fs::create_directories(final_.parent_path(), error);
  error.clear();
  path_ = os::make_unique_directory(final_.parent_path() / ("." + key_text(key) + "."), error);
  if (error) io::cannot_write_here(final_.parent_path(), error.message());
  fs::permissions(path_, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                             fs::perms::others_read | fs::perms::others_exec);
  when_interrupted_.emplace([path = path_] {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  });
}

WorkDirectory::~WorkDirectory() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

bool WorkDirectory::publish() {
  const os::Uninterrupted whole;
  if (is_damaged(directory_, key_)) fs::remove_all(final_);
  if (std::rename(path_.c_str(), final_.c_str()) == 0) {
    if (fs::exists(path_))
      throw std::runtime_error("the disk has not moved a result to " + final_.string());
    path_.clear();
    return true;
  }
  if (errno == EEXIST || errno == ENOTEMPTY) return false;
  throw std::runtime_error(fmt::format("cannot move {} to {}: {}", path_.string(), final_.string(),
                                       std::strerror(errno)));
}

} // namespace frictab::study
