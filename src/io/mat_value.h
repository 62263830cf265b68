// A MATLAB variable in memory, and the two readers that make them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/column_groups.h"

namespace frictab::io {

struct MatValue {
  enum class Kind { numbers, texts, structs, cells, other };
  std::string name, unit;
  Kind kind = Kind::other;
  std::vector<std::size_t> dims;  // as MATLAB counts them: rows first
  std::vector<double> numbers;    // column by column
  std::vector<std::string> texts; // rows of a char matrix
  std::vector<MatValue> elements; // of a cell
  // The fields of a struct array with their names, element by element.
  std::vector<std::vector<MatValue>> structs;
  bool in_order = false; // the fields are in the order of the struct, and not sorted by name
  std::string other;     // "a sparse matrix"
};

// Deeper nesting is not read.
inline constexpr int deepest_nesting = 16;
inline constexpr const char* too_deep = "a value nested too deeply";
inline constexpr const char* is_an_object =
    "a table or an object, which only MATLAB reads: writetable(T, \"test.csv\") or table2struct";

// Reason why a file cannot be read.
struct MatFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Number of elements; throws MatFault if a file of these bytes cannot contain so many, even
// compressed.
std::size_t count_of(const std::vector<std::size_t>& dims, std::uint64_t file_bytes);
// Rows of a char matrix from its characters (UTF-16 units, column by column), without the blanks
// that pad them.
std::vector<std::string> rows_of_text(const std::vector<std::size_t>& dims,
                                      const std::vector<char16_t>& characters);

// The variables of a file. To be called in a child process.
std::vector<MatValue> read_mat5(const std::filesystem::path& file);  // version 4 to 7
std::vector<MatValue> read_mat73(const std::filesystem::path& file); // version 7.3
// Their columns and groups.
ColumnGroups mat_groups(std::vector<MatValue>&& variables);

} // namespace frictab::io

namespace frictab::io::mat {

// Gives columns the names and units that the file holds as values of their own: a struct, a list or
// texts of units, a list of the names of a matrix's columns, a struct per channel. What is used is
// removed; returns notes.
std::vector<std::string> take_names_and_units(std::vector<MatValue>& variables);

} // namespace frictab::io::mat
