// Columns of a table, each with the quantity that its name or its cells suggest.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "guess/guess.h"
#include "io/csv.h"

namespace frictab::guess {

// True if at most a tenth of the cells that are not empty are texts.
bool is_number_column(const io::CsvColumn& column);

// The first column with this quantity; nullptr: there is none.
Column* find_column(std::vector<Column>& columns, const std::string& canonical);
// The column of the file.
const io::CsvColumn& raw_of(const Column& column, const io::CsvTable& table);
std::set<std::string> set_of(const std::vector<std::string>& cells);

std::vector<Column> guess_columns(const io::CsvTable& table);

} // namespace frictab::guess
