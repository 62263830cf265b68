// Workbooks as data files: the sheets that hold tests, and a sheet as columns.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/error.h"
#include "data/options.h"
#include "io/csv.h"
#include "io/workbook.h"

namespace frictab::data {

struct SheetChoice {
  std::vector<std::string> read;   // names, in the order of the tabs
  bool alone = true;               // the workbook has no other visible sheet
  std::vector<std::string> passed; // "'Deckblatt' (no row of numbers)": visible, and not read
};

// The sheets that DataOptions::sheets selects: those named; of "*" all visible ones with columns of
// the job; of none those with the job's column of friction or, where no sheet has it, those with
// the most columns of the job. `of_sheet`: the options by which a sheet is read. Throws InputError
// for names that are not there.
using OptionsOfSheet = std::function<DataOptions(const std::string& sheet)>;
SheetChoice choose_sheets(const std::string& path, const std::string& named,
                          const DataOptions& options, const OptionsOfSheet& of_sheet);

// The same for a table of tests: one sheet, the named one or the one with the most columns of the
// job among those with the column that names tests. Throws InputError if two have equally many.
std::string sheet_of_tests(const std::string& path, const std::string& named,
                           const DataOptions& options);

// Sets the units of columns by their cells' number formats and not by the header: fractions
// (unit 1) where they are shown in percent, s for times; notes say so. Adds a fault for a column
// that mixes kinds.
void take_cell_units(io::CsvTable& table, const io::Sheet& sheet, FaultList& faults);

// Reads a sheet as read_raw does, with take_cell_units. `format`: decimal and delimiter are those
// of io::Sheet.
io::CsvTable read_sheet(const std::string& path, const std::string& named, const std::string& sheet,
                        const io::CsvFormat& format, FaultList& faults);

} // namespace frictab::data
