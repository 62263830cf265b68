// One file in preparation for a campaign.
#pragma once

#include "data/dataset.h"
#include "data/mapping.h"
#include "data/raw.h"

namespace frictab::data {

// A file as a campaign, with the raw row of each of its rows.
struct Part {
  Dataset data;
  io::CsvTable raw;
  std::size_t raw_rows = 0;
  std::vector<std::size_t> row; // raw row
  bool measured_tau = true;
  bool whole_file = true; // false: some experiments of it
  FaultList faults;
  std::vector<MappedFile::CellFault> cell_faults;     // not reported yet
  std::vector<MappedFile::CountedNote> counted_notes; // of data.notes

  Column* find(std::string_view name);
  Place header() const { return {raw.file, raw.header_line, 0}; }
  Place place(std::size_t i) const { return row_place(raw, row[i]); }
  std::vector<std::string> raw_names() const; // names of the file's columns
};

// Notes with counts of rows, over several parts: equal notes are merged.
class CountedNotes {
public:
  void take(Part& part); // removes them from the notes of its data
  void add(const CountedNotes& more);
  std::vector<std::string> texts() const; // of all rows of all parts

private:
  std::vector<MappedFile::CountedNote> notes_;
  std::size_t raw_rows_ = 0;
};

// Orders rows so that each experiment is contiguous, in order of first appearance. `label` names
// the experiment if the file is one.
void gather_experiments(Part& part, MappedFile&& mapped, const std::string& label);

// Adds a note with a count, as text around the count (MappedFile::CountedNote).
void add_counted(Part& part, std::string before, std::string after, std::size_t rows);

// Keeps the rows whose `keep` is not 0; an experiment without a row is removed. With `if_none` a
// note names those experiments, and if no row is left at all, adds a fault with this text.
void keep_rows(Part& part, const std::vector<char>& keep, const char* if_none);

} // namespace frictab::data
