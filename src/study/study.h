// A study: many campaigns through the stages of one job. The contents of study.toml as plain
// values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "job/job.h"
#include "study/watched_files.h"
#include "twin/twin.h"

namespace frictab::study {

// The last stage that each campaign runs.
enum class LastStage { calibrate, trace, run };
const char* stage_name(LastStage stage);
std::optional<LastStage> stage_named(std::string_view name);
inline constexpr const char* stage_words = "calibrate, trace, run";

// The base job with one list of overrides; several campaigns share it.
struct ResolvedJob {
  job::Job job;
  // 16 hex digits: hash of the job and its shared files, without their paths
  std::string fingerprint;
  WatchedFiles shared; // tests, a second clock, laws
};

// A block [[twin]]: synthetic campaigns that differ only by their seed.
struct TwinBlock {
  twin::TwinOptions options; // its seed is set per campaign
  std::string text;          // the block's settings, keys in order
};

// The block and the seed of a synthetic campaign.
struct TwinSeed {
  std::size_t block = 0; // index in Study::twins
  std::uint64_t seed = 0;
};

struct Campaign {
  std::string name;
  std::vector<std::string> training, validation; // files, relative to the job's folder
  std::size_t job = 0;                           // index in Study::jobs
  std::optional<TwinSeed> twin;                  // instead of files
  std::vector<std::string> factors;              // per Study::factors; empty: not given
  Place place;
};

struct Study {
  std::string file, directory;
  std::string command_line_options; // as advice repeats them
  LastStage stage = LastStage::trace;
  std::vector<ResolvedJob> jobs;
  std::vector<TwinBlock> twins;
  std::vector<std::string> factors; // "lubricant"; in the order in which campaigns first name them
  std::vector<Campaign> campaigns;

  bool is_synthetic() const { return !twins.empty(); }
};

// Settings of the command line that replace those of the file.
struct StudyOverrides {
  std::string directory; // empty: as the file has it
  std::optional<LastStage> stage;
  std::vector<std::string> set; // "key=value" for every campaign, after its own overrides
};

inline constexpr std::size_t most_campaigns = 1000000;

// Reads study.toml, the list of campaigns and the base job with the overrides of each campaign.
// Data files are not opened. Throws InputError with every fault of these files.
Study read_study(const std::string& file, const StudyOverrides& overrides = {});
Study parse_study(std::string_view text, const std::string& file,
                  const StudyOverrides& overrides = {});

} // namespace frictab::study
