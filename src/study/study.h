// A study: many campaigns through the stages of one job. study.toml as plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "job/job.h"
#include "twin/twin.h"

namespace frictab::study {

// How far each campaign is taken.
enum class LastStage { calibrate, trace, run };
const char* stage_name(LastStage stage);
std::optional<LastStage> stage_named(std::string_view name);
inline constexpr const char* stage_words = "calibrate, trace, run";

// The base job with one list of overrides; several campaigns share it.
struct ResolvedJob {
  job::Job job;
  std::string fingerprint; // 16 hex digits: all it says but where files lie, and what they hold
};

// A block [[twin]]: synthetic campaigns that differ by their seed alone.
struct TwinBlock {
  twin::TwinOptions options; // its seed is set per campaign
  std::string text;          // what the block says of them, keys in order
};

// Which campaign of which twin.
struct TwinSeed {
  std::size_t block = 0; // of Study::twins
  std::uint64_t seed = 0;
};

struct Campaign {
  std::string name;
  std::vector<std::string> training, validation; // files, relative to the job's folder
  std::size_t job = 0;                           // of Study::jobs
  std::optional<TwinSeed> twin;                  // instead of files
  std::vector<std::string> factors;              // per Study::factors; empty: not said
  Place place;
};

struct Study {
  std::string file, directory;
  std::string said; // options of the command line, as advice repeats them
  LastStage stage = LastStage::trace;
  std::vector<ResolvedJob> jobs;
  std::vector<TwinBlock> twins;
  std::vector<std::string> factors; // "lubricant", in the order in which they are named first
  std::vector<Campaign> campaigns;

  bool is_synthetic() const { return !twins.empty(); }
};

// What the command line says instead of the file.
struct StudyOverrides {
  std::string directory; // empty: as the file has it
  std::optional<LastStage> stage;
  std::vector<std::string> set; // "key=value" for every campaign, behind its own
};

inline constexpr std::size_t most_campaigns = 1000000;

// Reads study.toml, the list of campaigns and the base job with the overrides of each campaign.
// Data files are not opened. Throws InputError with every fault of these files.
Study read_study(const std::string& file, const StudyOverrides& overrides = {});
Study parse_study(std::string_view text, const std::string& file,
                  const StudyOverrides& overrides = {});

} // namespace frictab::study
