// Maps a file's own columns to canonical ones: names and units.
#pragma once

#include "data/dataset.h"
#include "data/options.h"
#include "data/raw.h"

namespace frictab::data {

// One file, mapped but not yet cut into experiments.
struct MappedFile {
  std::vector<Column> columns;
  std::vector<std::string> experiment; // per row; empty if the file is one experiment
  bool intervals = false;              // experiments are the intervals between header lines
  std::vector<std::string> notes;
  std::vector<std::string> not_read; // columns, by name or number
  std::vector<AssumedUnit> assumed;
  struct CellFault { // of one cell; reported only if its row is not left out
    std::size_t row;
    Fault fault;
    std::string cause;    // shared by cells with the same fault
    bool missing = false; // the cell is empty: DataOptions::missing
  };
  std::vector<CellFault> cell_faults;
  struct CountedNote { // a note with a count of rows, summed over the parts of a file
    std::size_t note;  // its index in `notes`
    // Text around the counts, as in "x: 3 of 60 rows without a value"; the counts are those of all
    // parts, and the second one is omitted if all rows are meant.
    std::string before, after;
    bool of_all;
    std::size_t rows, of;
    std::string text() const;
  };
  std::vector<CountedNote> counted_notes;
};

// Adds every fault of the file's columns to `faults`; faults of cells are in the result. `label` is
// the file's part in the names of its experiments. Only names, units and lines of `raw` are left.
MappedFile map_columns(io::CsvTable& raw, const Reading& options, const std::string& label,
                       FaultList& faults);

// Consecutive rows of one experiment.
struct ExperimentRun {
  std::size_t first; // row
  std::string name;  // its name in the file; empty if the file is one experiment
};
// Returns the runs in the order of the rows. `faults`: as map_columns adds them.
std::vector<ExperimentRun> experiment_runs(io::CsvTable& raw, const Reading& options,
                                           FaultList& faults);

} // namespace frictab::data
