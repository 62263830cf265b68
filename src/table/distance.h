// Distance of states from the tests on which a law was calibrated. The ranges of the data are a
// box, which tests fill unevenly: its corners may be far from every test, and states through which
// each test passes within a few rows, as while the load builds up, are hardly tested either. So
// tests are counted, not rows: a state is as far from the tests as the radius of the ball around it
// that holds half a test's worth of rows, each row counting as its share of its test.
//
// The distance between two states is Euclidean over the axes of the table, each in its own
// coordinate (ln where the axis is logarithmic) and divided by the span of the data in it. Where
// the data have a single value, the divisor is that value (1 in ln). Distance 1 is thus the whole
// range of the data along one axis.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "data/dataset.h"
#include "models/assembled_law.h"
#include "table/table.h"

namespace frictab::table {

// Distance beyond which a state is called far from the tests, or thinly tested.
inline constexpr double far_from_tests = 0.25;
// How many tests' worth of rows a state needs within that distance.
inline constexpr double enough_tests = 0.5;

// The rows of all tests in the coordinates of given axes, in a k-d tree: at most 64 of each test,
// evenly spaced. Rows without a finite coordinate (empty cells, speed 0 on a logarithmic axis) do
// not count.
class TestRows {
public:
  // columns: values of the axes' quantities, one span of first_row.back() rows each. first_row:
  // first row of each experiment, and the end.
  TestRows(std::vector<TableAxis> axes, const std::vector<std::span<const double>>& columns,
           std::span<const std::size_t> first_row);
  ~TestRows();
  TestRows(const TestRows&) = delete;
  TestRows& operator=(const TestRows&) = delete;

  bool empty() const; // no row counts

  // Distance from a state, in the order of the axes, within which enough_tests lie; infinite if all
  // rows together are fewer. A coordinate that is not finite is infinitely far.
  double distance(std::span<const double> state) const;

  // Share of the box of the axes, evenly filled in their coordinates (4,096 Halton points), that is
  // further than far_from_tests from the tests.
  double share_far() const;

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// Fills in table.distance and record.share_far. Does nothing for a table without axes, or if no row
// counts. Parallel; the same bytes on any number of threads.
void add_distance(Table& table, const models::AssembledLaw& law, const data::Dataset& data);

// "34 % of the table extrapolates: less than half a test within 1/4 of the measured spans"; empty
// if the share is not known.
std::string distance_text(const Table& table);

} // namespace frictab::table
