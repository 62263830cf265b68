// How far the states of a table are from the tests that its law was calibrated on. The ranges of
// the data are a box; tests fill it unevenly, and in its corners a law may never have been asked.
//
// Distance of two states: Euclidean over the axes of the table, each in its own coordinate (ln
// where the axis is logarithmic) and divided by what the data span of it there; where the data hold
// one value, by that value (in ln by 1). So 1 is the whole range of the data of one axis.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "data/dataset.h"
#include "models/assembled_law.h"
#include "table/table.h"

namespace frictab::table {

// A state further than that from every test is called far.
inline constexpr double far_from_tests = 0.25;

// The rows of all tests in the coordinates of some axes, in a k-d tree. Rows of one test that are
// closer than a hundredth of the span in every axis count once; rows without a finite coordinate
// (empty cells, speed 0 on a logarithmic axis) do not count.
class TestRows {
public:
  // columns: values of the axes' quantities, one span of first_row.back() rows each. first_row: of
  // each experiment, and the end.
  TestRows(std::vector<TableAxis> axes, const std::vector<std::span<const double>>& columns,
           std::span<const std::size_t> first_row);
  ~TestRows();
  TestRows(const TestRows&) = delete;
  TestRows& operator=(const TestRows&) = delete;

  bool empty() const; // no row counts

  // From a state, in the order of the axes, to the nearest row. Infinite where there is none.
  double distance(std::span<const double> state) const;

  // Share of the box of the axes, evenly filled in their coordinates (4,096 Halton points), that is
  // further than far_from_tests from every row.
  double share_far() const;

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// Fills in table.distance (not of values that lie in a file: looking up the rows takes longer than
// the values) and record.share_far. Does nothing for a table without axes, or where no row counts.
// Parallel; the same bytes on any number of threads.
void add_distance(Table& table, const models::AssembledLaw& law, const data::Dataset& data);

// "34 % of its range is far from every test: by more than a quarter of what the data span of one
// axis"; empty where that is not known.
std::string distance_text(const Table& table);

} // namespace frictab::table
