// Cuts the rows of a file where an experiment ends.
#include "data/raw_parts.h"

#include <memory>
#include <unordered_set>

#include <fmt/format.h>

#include "data/group_columns.h"
#include "data/mapping.h"
#include "data/rig_files.h"
#include "data/wide.h"
#include "io/file_streams.h"
#include "io/hdf5.h"
#include "io/workbook.h"

namespace frictab::data {

namespace {

// Enough rows to justify a thread, few enough for many parts in memory.
constexpr std::size_t rows_of_a_part = 50'000;
// Ratio of HDF5 pieces to text pieces; they are larger because each starts a process.
constexpr std::uint64_t hdf5_pieces = 8;

class Cutter {
public:
  explicit Cutter(const Reading& options) : options_(options) {}

  void add(io::CsvTable&& more, FaultList& faults) {
    if (more.rows() == 0) {
      pending_.counts.insert(pending_.counts.end(), more.counts.begin(), more.counts.end());
      pending_.notes.insert(pending_.notes.end(), more.notes.begin(), more.notes.end());
      return;
    }
    const std::size_t before = pending_.rows();
    for (ExperimentRun& run : experiment_runs(more, options_, faults)) {
      if (!runs_.empty() && runs_.back().name == run.name) continue;
      if (!seen_.insert(run.name).second) refuse(more, run);
      runs_.push_back({before + run.first, std::move(run.name)});
    }
    if (before == 0 && pending_.columns.empty())
      pending_ = std::move(more);
    else
      io::append(pending_, std::move(more));
  }

  // All experiments except the last, which may continue; at the end of the file that one as well.
  std::vector<io::CsvTable> whole(bool at_end) {
    std::vector<io::CsvTable> parts;
    const std::size_t end = at_end || runs_.empty() ? pending_.rows() : runs_.back().first;
    std::size_t from = 0;
    for (std::size_t r = 1; r <= runs_.size(); ++r) {
      const std::size_t to = r < runs_.size() ? runs_[r].first : pending_.rows();
      if (to > end) break;
      if (to - from < rows_of_a_part && to != end) continue;
      if (from == 0 && to == pending_.rows()) // avoids a copy of a large experiment
        parts.push_back(std::move(pending_));
      else
        parts.push_back(io::rows_of(pending_, from, to));
      pending_.counts.clear(); // of the first part only
      from = to;
    }
    if (from > 0) forget(from, at_end);
    return parts;
  }

private:
  void forget(std::size_t rows, bool at_end) {
    if (at_end) {
      pending_ = {};
      runs_.clear();
      return;
    }
    pending_ = io::rows_of(pending_, rows, pending_.rows());
    pending_.notes.clear();
    runs_ = {{0, std::move(runs_.back().name)}};
  }

  [[noreturn]] static void refuse(const io::CsvTable& table, const ExperimentRun& run) {
    const std::string row =
        table.header_line > 0 ? "" : fmt::format(" in row {}", table.line[run.first]);
    throw InputError(
        row_place(table, run.first),
        fmt::format("experiment '{}' comes again{}, after rows of another one", run.name, row),
        "data that are condensed are read one experiment at a time: sort the file by "
        "experiment, or data.condense = 0 where all rows find room in memory");
  }

  const Reading& options_;
  io::CsvTable pending_;
  std::vector<ExperimentRun> runs_; // of the pending rows
  std::unordered_set<std::string> seen_;
};

void read_whole(const std::string& path, const std::string& named, const Reading& options,
                FaultList& faults, const TakeParts& take) {
  io::CsvTable raw = read_raw(path, named, options, faults);
  if (are_side_by_side(options)) {
    std::vector<io::CsvTable> one;
    one.push_back(end_to_end(std::move(raw), options));
    return take(std::move(one));
  }
  Cutter cutter(options);
  cutter.add(std::move(raw), faults);
  take(cutter.whole(true));
}

// `next` returns pieces in the order of the file, and none at its end.
void cut_pieces(const std::function<std::vector<io::CsvTable>()>& next, const Reading& options,
                FaultList& faults, const TakeParts& take) {
  Cutter cutter(options);
  for (bool more = true; more;) {
    std::vector<io::CsvTable> pieces = next();
    more = !pieces.empty();
    for (io::CsvTable& piece : pieces)
      if (faults.empty()) cutter.add(std::move(piece), faults);
    if (!faults.empty()) return;
    std::vector<io::CsvTable> parts = cutter.whole(!more);
    if (!parts.empty()) take(std::move(parts));
  }
}

} // namespace

void read_raw_parts(const std::string& path, const std::string& named, const Reading& options,
                    FaultList& faults, const TakeParts& take) {
  const bool held = io::looks_like_workbook(path) || is_rig_file(path) ||
                    are_side_by_side(options) || !options.join.files.empty() ||
                    is_cut_whole(options);
  if (held) return read_whole(path, named, options, faults, take);
  if (io::looks_like_hdf5(path)) {
    GroupColumns columns(path, named, options, faults);
    if (!faults.empty()) return;
    const auto next = [&] {
      std::vector<io::CsvTable> pieces;
      io::CsvTable piece = columns.next(hdf5_pieces * options.piece_bytes);
      if (piece.rows() > 0) pieces.push_back(std::move(piece));
      return pieces;
    };
    return cut_pieces(next, options, faults, take);
  }
  io::CsvPieces pieces(std::make_unique<io::InputFile>(path, named), named,
                       csv_format(path, options), options.piece_bytes);
  if (!pieces.whole_because().empty()) return read_whole(path, named, options, faults, take);
  cut_pieces([&] { return pieces.next(faults); }, options, faults, take);
}

} // namespace frictab::data
