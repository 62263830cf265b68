// Reads parts of files, condenses them, and reads them again on request.
#include "data/load_condensed.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <mutex>

#include "core/large_work.h"
#include "core/parallel.h"
#include "data/append.h"
#include "data/condense.h"
#include "data/file_list.h"
#include "data/group_columns.h"
#include "data/leave_out.h"
#include "data/load_part.h"
#include "data/plausibility.h"
#include "data/raw_parts.h"
#include "io/file_streams.h"
#include "io/hdf5.h"

namespace frictab::data {

namespace {

namespace fs = std::filesystem;

// Total size limit of files read in parallel: a file needs a few times its size in memory.
constexpr std::uint64_t bytes_side_by_side = std::uint64_t{128} << 20;

std::uint64_t size_of(const fs::path& path) {
  std::error_code unknown;
  const auto bytes = fs::file_size(path, unknown);
  return unknown ? 0 : bytes;
}

// Position of a part in the campaign.
struct PartNumber {
  std::size_t file, part;
  bool operator<(const PartNumber& other) const {
    return std::pair(file, part) < std::pair(other.file, other.part);
  }
};

// The files of a campaign, which can be read part by part any number of times.
class Campaign : public RowSource {
public:
  Campaign(const std::vector<std::string>& named, const Reading& options)
      : options_(options), beside_(load_beside(options_)),
        plans_(plan_files(find_files(named, options_.base, options_.place), options_)),
        files_(names_of(plans_)) {}

  const std::vector<std::string>& files() const { return files_; }
  const std::vector<std::string>& notes() const { return plans_.notes; }
  const Beside& beside() const { return beside_; }

  // Calls take(number, part) on any thread; returns the faults that belong to no part, by file.
  using Take = std::function<void(PartNumber number, Part&& part)>;
  std::vector<FaultList> read_parts(const Take& take) const {
    std::vector<FaultList> faults(files_.size());
    for (std::size_t first = 0; first < files_.size();) {
      const std::size_t end = end_of_contiguous_parts(first);
      parallel_for(end - first,
                   [&](std::size_t i) { read_file(first + i, faults[first + i], take); });
      first = end;
    }
    return faults;
  }

  void read(const std::function<void(const Dataset& one)>& take) const override {
    const std::vector<FaultList> faults = read_parts([&](PartNumber, Part&& part) {
      part.faults.throw_if_any();
      const Dataset& data = part.data;
      for (std::size_t e = 0; e < data.experiments.size(); ++e)
        if (data.experiments.size() == 1)
          take(data);
        else
          take(data.subset(std::array{e}));
    });
    throw_faults(faults);
  }

private:
  std::size_t end_of_contiguous_parts(std::size_t first) const {
    std::uint64_t bytes = 0;
    std::size_t end = first;
    while (end < files_.size()) {
      bytes += size_of(path_of(plans_.files[end]));
      if (end > first && bytes > bytes_side_by_side) break;
      ++end;
    }
    return end;
  }

  void read_file(std::size_t file, FaultList& faults, const Take& take) const {
    const FilePlan& plan = plans_.files[file];
    std::size_t before = 0;
    try {
      large_work(reading_words(plan), 0, one_experiment_at_a_time, [&] {
        read_raw_parts(path_of(plan).string(), plan.name, plan.options, faults,
                       [&](std::vector<io::CsvTable>&& parts) {
                         parallel_for(parts.size(), [&](std::size_t i) {
                           take({file, before + i}, load_part(std::move(parts[i]), plan, beside_));
                         });
                         before += parts.size();
                       });
      });
    } catch (const InputError& error) {
      faults.add(error);
    }
  }

  Reading options_; // without the columns taken from the table of tests
  Beside beside_;
  FilePlans plans_;
  std::vector<std::string> files_; // names of the plans
};

// Results of the first pass over a campaign.
class FirstLook {
public:
  FirstLook(const Reading& options, std::size_t blocks, std::shared_ptr<const Campaign> campaign)
      : options_(options), blocks_(blocks), campaign_(std::move(campaign)),
        faults_(campaign_->files().size()) {
    while (is_auto() && campaign_->files().size() * blocks_ > most_blocks &&
           blocks_ > coarse_blocks)
      blocks_ = fewer(); // each file has at least one experiment
  }

  Dataset held() {
    std::vector<FaultList> of_files;
    while (!all_read(of_files)) // repeats the pass if experiments had too many blocks
      blocks_ = fewer();
    for (auto& [number, found] : parts_)
      for (const Fault& fault : found.faults)
        faults_[number.file].add(fault.place, fault.what, fault.hint);
    for (std::size_t f = 0; f < faults_.size(); ++f)
      for (const Fault& fault : of_files[f].all())
        faults_[f].add(fault.place, fault.what, fault.hint);
    report_empty_files();
    throw_faults(faults_);
    return appended();
  }

private:
  struct TooManyBlocks {};

  bool is_auto() const { return !options_.condense.value; }
  std::size_t fewer() const { return std::max(blocks_ / 2, coarse_blocks); }

  bool all_read(std::vector<FaultList>& of_files) {
    parts_.clear();
    held_ = 0;
    try {
      of_files = campaign_->read_parts([&](PartNumber number, Part&& part) { take(number, part); });
    } catch (const TooManyBlocks&) {
      return false;
    }
    return true;
  }

  struct Found { // in one part
    Dataset blocks;
    std::vector<Fault> faults;
    std::vector<Implausible> implausible;
    CountedNotes notes;
  };

  void take(PartNumber number, Part& part) {
    Found found;
    found.faults = part.faults.all();
    found.notes.take(part);
    if (found.faults.empty()) {
      count_implausible(part.data, found.implausible);
      found.blocks = condense(part.data, blocks_, campaign_);
    }
    const std::lock_guard lock(mutex_);
    held_ += found.blocks.rows();
    if (held_ > most_blocks && blocks_ > coarse_blocks && is_auto()) throw TooManyBlocks();
    parts_.emplace(number, std::move(found));
  }

  // Reports files without any row left; data.drop may remove all rows of an experiment, but not of
  // a file.
  void report_empty_files() {
    std::vector<std::size_t> rows(faults_.size(), 0);
    for (const auto& [number, found] : parts_)
      rows[number.file] += found.blocks.rows() + found.blocks.at_rest.size();
    for (std::size_t f = 0; f < faults_.size(); ++f)
      if (rows[f] == 0 && faults_[f].empty() && options_.join.files.empty())
        faults_[f].add({campaign_->files()[f], 0, 0},
                       "data.drop and data.missing leave no row of this file");
  }

  Dataset appended() {
    Dataset all;
    bool first = true;
    for (auto& [number, found] : parts_) {
      const std::string& file = campaign_->files()[number.file];
      notes_.add(found.notes);
      merge_implausible(found.implausible, implausible_);
      if (found.blocks.rows() == 0) {
        absorb(without_rows_, found.blocks);
        continue;
      }
      if (first) {
        all = std::move(found.blocks);
        all.sources = {campaign_->files().front()}; // named by faults of the others
        first = false;
        continue;
      }
      FaultList faults;
      append(all, std::move(found.blocks), file, faults);
      faults.throw_if_any();
    }
    all.sources = campaign_->files();
    finish(all);
    return all;
  }

  void finish(Dataset& all) {
    absorb(all, without_rows_);
    for (std::string& note : notes_.texts())
      all.notes.push_back(std::move(note));
    all.notes.insert(all.notes.begin(), campaign_->notes().begin(), campaign_->notes().end());
    if (all.condensed) all.condensed->implausible = std::move(implausible_);
  }

  const Reading& options_;
  std::size_t blocks_; // per experiment
  std::shared_ptr<const Campaign> campaign_;
  std::mutex mutex_;
  std::size_t held_ = 0; // blocks so far
  std::map<PartNumber, Found> parts_;
  std::vector<FaultList> faults_; // by file
  CountedNotes notes_;            // of all parts
  std::vector<Implausible> implausible_;
  Dataset without_rows_; // notes and counts of parts without rows
};

// ---- number of rows ----

// Estimates the rows of a text file from its size and the length of its first few thousand lines.
double rows_of_text(const fs::path& path, std::uint64_t bytes) {
  const std::string start = io::first_bytes(path, std::size_t{1} << 18);
  const auto lines = std::count(start.begin(), start.end(), '\n');
  return lines == 0 ? 0
                    : static_cast<double>(bytes) * static_cast<double>(lines) /
                          static_cast<double>(start.size());
}

// Number of rows by shape. Faults are ignored here and reported when the file is read.
double rows_of_hdf5(const fs::path& path, const DataOptions& options) {
  try {
    FaultList ignored;
    return static_cast<double>(GroupColumns(path.string(), path.string(), options, ignored).rows());
  } catch (const InputError&) {
    return 0;
  }
}

double estimated_rows(const fs::path& path, std::uint64_t bytes, const DataOptions& options) {
  return io::looks_like_hdf5(path) ? rows_of_hdf5(path, options) : rows_of_text(path, bytes);
}

} // namespace

std::size_t blocks_to_condense(const DataOptions& options) {
  if (options.condense.value) return static_cast<std::size_t>(*options.condense.value);
  constexpr std::uint64_t least_bytes_of_a_row = 4; // "1,2" and the end of its line
  std::vector<fs::path> paths;
  std::uint64_t bytes = 0;
  for (const auto& files : {options.training, options.validation})
    for (const std::string& file : find_files(files, options.base, options.place)) {
      paths.push_back(fs::path(options.base) / file);
      bytes += size_of(paths.back());
    }
  if (bytes < many_rows * least_bytes_of_a_row) return 0;
  double rows = 0;
  for (const fs::path& path : paths)
    rows += estimated_rows(path, size_of(path), options);
  return rows > static_cast<double>(many_rows) ? fine_blocks : 0;
}

Dataset load_condensed(const std::vector<std::string>& files, const ReadRequest& options,
                       std::size_t blocks) {
  Reading now = options;
  auto campaign = std::make_shared<const Campaign>(files, now);
  Dataset all = FirstLook(now, blocks, campaign).held();
  while (look_again(all, now)) {
    campaign = std::make_shared<const Campaign>(files, now);
    all = FirstLook(now, blocks, campaign).held();
  }
  complete(all, options, campaign->beside());
  return all;
}

} // namespace frictab::data
