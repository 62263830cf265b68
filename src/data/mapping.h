// From a file's own columns to canonical ones: names and units.
#pragma once

#include "data/dataset.h"
#include "data/options.h"
#include "data/raw.h"

namespace frictab::data {

// One file, mapped, not yet cut into experiments.
struct MappedFile {
  std::vector<Column> columns;
  std::vector<std::string> experiment; // per row; empty where the file is one
  bool intervals = false;              // they are those between header lines
  std::vector<std::string> notes;
  std::vector<AssumedUnit> assumed;
  struct CellFault { // of one cell: told only where its row is not left out
    std::size_t row;
    Fault fault;
    std::string cause;    // the same of cells that have the same fault
    bool missing = false; // the cell is empty: DataOptions::missing
  };
  std::vector<CellFault> cell_faults;
  struct CountedNote { // one of `notes` that counts rows: those of parts of a file are one
    std::size_t note;  // its number
    // "x: 3 of 60 rows without a value": around the counts, which are those of all parts; without
    // the second one where all rows are meant.
    std::string before, after;
    bool of_all;
    std::size_t rows, of;
    std::string text() const;
  };
  std::vector<CountedNote> counted_notes;
};

// Adds every fault of the file's columns to `faults`; those of cells are in the result. `label` is
// the file's part in the names of its experiments. Of `raw` names, units and lines are left.
MappedFile map_columns(io::CsvTable& raw, const DataOptions& options, const std::string& label,
                       FaultList& faults);

// Rows of one experiment that follow each other.
struct ExperimentRun {
  std::size_t first; // row
  std::string name;  // as the file calls it; empty where the file is one
};
// In the order of the rows. `faults`: as map_columns adds them.
std::vector<ExperimentRun> experiment_runs(io::CsvTable& raw, const DataOptions& options,
                                           FaultList& faults);

} // namespace frictab::data
