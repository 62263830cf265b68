// Results of campaigns in the study's directory: results/KEY/ and failed/KEY.json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/os/interrupt.h"
#include "study/result.h"

namespace frictab::study {

inline constexpr const char* result_file = "study.json"; // in results/KEY
inline constexpr const char* results_folder = "results";
inline constexpr const char* failures_folder = "failed";

std::filesystem::path result_directory(const std::string& directory, std::uint64_t key);
// The campaign's study.json. Throws InputError if it is missing, damaged or another campaign's.
CampaignResult read_result(const std::string& directory, std::uint64_t key);
// How the files of a result differ from what was written: study.json has the hash of stages.json,
// and that has those of all others. Empty: not at all.
std::vector<std::string> differences_of_result(const std::string& directory, std::uint64_t key);
std::filesystem::path failure_path(const std::string& directory, std::uint64_t key);

// A failed campaign.
struct Failure {
  std::string campaign, message;
  bool by_input = false; // fault of its job or data, which a new attempt would meet again
};
void write_failure(const std::string& directory, std::uint64_t key, const Failure& failure);
Failure read_failure(const std::string& directory, std::uint64_t key);

// A directory of this process, results/.KEY.XXXXXX, until it is published or removed with its
// contents.
class WorkDirectory {
public:
  WorkDirectory(const std::string& directory, std::uint64_t key);
  ~WorkDirectory();
  WorkDirectory(const WorkDirectory&) = delete;
  WorkDirectory& operator=(const WorkDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // Becomes results/KEY by rename(2), in place of a result that is damaged. False where another
  // process was first; its result is kept.
  bool publish();

private:
  std::string directory_;
  std::uint64_t key_;
  std::filesystem::path final_, path_;
  std::optional<os::WhenInterrupted> when_interrupted_;
};

} // namespace frictab::study
