// Arrangement of tests in a file: one below the other, side by side, in parts, or one per row.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "guess/guess.h"
#include "io/csv.h"

namespace frictab::guess {

// Finds parts below repeated headers. A rig that heats, loads and slides writes three, of which the
// longest has many times the rows of the shortest.
void take_intervals(File& file, const io::CsvTable& table);

// Leaves the columns of the first test, which stand for those of all, if all columns come again
// under equal names.
void take_tests_side_by_side(File& file, const io::CsvTable& table);

// Finds columns called "mu T1 10MPa", "mu T2 20MPa": a word for friction, and a test's own name.
void find_tests_in_columns(File& file);

bool each_row_is_a_test(const File& file, const io::CsvTable& table);

// Pattern of lines without a delimiter that stand in front of the first row and between others;
// empty: there are none.
std::string titles_in(std::string_view text, const io::CsvTable& table);

// Number of lines below the last row: means, remarks. They hold fewer than half as many numbers as
// a row, a text where rows begin with a number, or a word for sums.
std::size_t footer_of(std::string_view text, const io::CsvTable& table,
                      const io::CsvFormat& format);

// A regular expression for just this text.
std::string as_pattern(const std::string& text);

} // namespace frictab::guess
