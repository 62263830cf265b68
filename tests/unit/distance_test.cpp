// How far the nodes of tables are from the tests: against a search of all rows, in files, on
// threads.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "core/random.h"
#include "io/hdf5.h"
#include "support/run_command.h"
#include "support/sample_data.h"
#include "table/build.h"
#include "table/direct.h"
#include "table/distance.h"
#include "table/table_file.h"

namespace frictab::distance_test {
namespace {

using table::Table;
using table::TableAxis;
using table::TestRows;

TableAxis axis(const char* name, bool log, double low, double high) {
  TableAxis axis;
  axis.name = name;
  axis.unit = "1";
  axis.log = log;
  axis.nodes = {low, high};
  return axis;
}

// Tests along curves in two states, the second of them logarithmic from 1 to 100.
struct Curves {
  Curves() {
    Random random(3, 1);
    for (std::size_t test = 0; test < 8; ++test) {
      const double start = random.uniform(), slope = random.uniform(-1, 1);
      for (int i = 0; i < 60; ++i) {
        x.push_back(10 * std::clamp(start + slope * i / 60.0, 0.0, 1.0));
        y.push_back(std::pow(100.0, random.uniform()));
      }
      first_row.push_back(x.size());
    }
    x.front() = 0, y.front() = 1, x.back() = 10, y.back() = 100;
  }
  // Radius that holds half a test: 30 of all rows, since each test has 60.
  double half_a_test(double a, double b) const {
    std::vector<double> all;
    for (std::size_t i = 0; i < x.size(); ++i)
      all.push_back(std::hypot((x[i] - a) / 10, std::log(y[i] / b) / std::log(100.0)));
    std::nth_element(all.begin(), all.begin() + 29, all.end());
    return all[29];
  }
  std::vector<double> x, y;
  std::vector<std::size_t> first_row{0};
};

TEST(TestRows, AreCountedAsBySearchOfAllOfThem) {
  const Curves c;
  const TestRows rows({axis("x", false, 0, 10), axis("y", true, 1, 100)}, {c.x, c.y}, c.first_row);
  Random random(4, 1);
  for (int i = 0; i < 2000; ++i) {
    const double a = random.uniform(-5, 15), b = std::pow(100.0, random.uniform(-0.5, 1.5));
    EXPECT_NEAR(rows.distance(std::vector{a, b}), c.half_a_test(a, b), 1e-12);
  }
}

// Each of 20 tests builds up through the low half of the axis in 2 % of its rows and stays at its
// end: 20 rows at each low place are no half test.
TEST(TestRows, OfABuildUpThatEveryTestPassesThroughDoNotCountAsTests) {
  std::vector<double> x;
  std::vector<std::size_t> first_row{0};
  for (int test = 0; test < 20; ++test) {
    for (int i = 0; i < 500; ++i)
      x.push_back(i < 10 ? i : 100 + 0.01 * test);
    first_row.push_back(x.size());
  }
  const TestRows rows({axis("x", false, 0, 100)}, {x}, first_row);
  EXPECT_GT(rows.distance(std::vector{5.0}), table::far_from_tests);
  EXPECT_LT(rows.distance(std::vector{100.0}), 0.01);
}

TEST(TestRows, AreFarFromEverythingIfTheyAreFewerThanHalfATest) {
  const std::vector<double> x{std::nan(""), std::nan(""), 3};
  const std::vector<std::size_t> first_row{0, 3};
  const TestRows rows({axis("x", false, 0, 10)}, {x}, first_row);
  EXPECT_EQ(rows.distance(std::vector{3.0}), HUGE_VAL);
}

TEST(TestRows, AreAtDistanceZeroFromThemselvesAndOneFromTheOtherEndOfTheirRange) {
  const std::vector<double> x{2, 4};
  const std::vector<std::size_t> first_row{0, 1, 2};
  const TestRows rows({axis("x", false, 0, 10)}, {x}, first_row);
  EXPECT_EQ(rows.distance(std::vector{2.0}), 0);
  EXPECT_EQ(rows.distance(std::vector{3.0}), 0.5);
  EXPECT_EQ(rows.distance(std::vector{6.0}), 1);
  // Within 0.5, a quarter of what they span, lie 1.5 to 2.5 and 3.5 to 4.5 of 0 to 10.
  EXPECT_NEAR(rows.share_far(), 0.8, 0.002);
}

TEST(TestRows, OfOneValueTakeThatValueForTheSpan) {
  const std::vector<double> x{5, 5};
  const std::vector<std::size_t> first_row{0, 2};
  const TestRows rows({axis("x", false, 0, 10)}, {x}, first_row);
  EXPECT_EQ(rows.distance(std::vector{10.0}), 1);
  EXPECT_NEAR(rows.share_far(), 0.75, 0.002);
  const TestRows widened({axis("x", true, 4.95, 5.05)}, {x}, first_row);
  EXPECT_NEAR(widened.distance(std::vector{5.05}), 0.00995, 1e-5);
  EXPECT_EQ(widened.share_far(), 0);
}

TEST(TestRows, WithoutAFiniteCoordinateDoNotCount) {
  const std::vector<double> x{0, 1, std::nan(""), 10}, none{0, 0, 0, 0};
  const std::vector<std::size_t> first_row{0, 4};
  const TestRows rows({axis("x", true, 1, 10)}, {x}, first_row);
  EXPECT_EQ(rows.distance(std::vector{1.0}), 1); // half of the test is its two finite rows
  EXPECT_NEAR(rows.distance(std::vector{std::sqrt(10.0)}), 0.5, 1e-12);
  EXPECT_TRUE(TestRows({axis("x", true, 1, 10)}, {none}, first_row).empty());
}

class TableDistance : public testing::Test {
protected:
  TableDistance()
      : law(test::plausible_model(*models::find_law("wzl"))), data(test::sample_data(law.model)),
        table(table::build_table(law, table::state_ranges(law, data, {}), {})) {
    table::add_distance(table, law, data);
  }
  const models::AssembledLaw law;
  const data::Dataset data;
  Table table;
};

TEST_F(TableDistance, OfEveryNodeIsThatOfItsState) {
  ASSERT_EQ(table.distance.size(), table.nodes());
  std::vector<std::span<const double>> columns;
  for (const TableAxis& axis : table.axes)
    columns.push_back(data.values(axis.name));
  const TestRows rows(table.axes, columns, data.first_row);
  std::vector<double> last, first;
  for (const TableAxis& axis : table.axes) {
    first.push_back(axis.nodes.front());
    last.push_back(axis.nodes.back());
  }
  EXPECT_EQ(table.distance.front(), rows.distance(first));
  EXPECT_EQ(table.distance.back(), rows.distance(last));
  EXPECT_EQ(table.record.share_far, rows.share_far());
  EXPECT_GT(*std::ranges::max_element(table.distance), 0);
}

TEST_F(TableDistance, StandsInTheFileOnTheAxesOfTheValues) {
  const test::TemporaryDirectory directory;
  write_table(table, directory.path("t.h5"));
  const io::Hdf5Reader file(directory.path("t.h5"), "t.h5");
  EXPECT_EQ(file.values("distance"), table.distance);
  EXPECT_EQ(file.shape("distance"), file.shape("value"));
  for (std::size_t a = 0; a < table.axes.size(); ++a)
    EXPECT_EQ(file.scale("distance", a), table.axes[a].name);
  EXPECT_EQ(file.text_attribute("distance", "units"), "1");
  const Table again = table::read_table(directory.path("t.h5"));
  EXPECT_EQ(again.value, table.value);
  EXPECT_EQ(again.record.share_far, table.record.share_far);
}

TEST_F(TableDistance, IsTheSameOnAnyNumberOfThreads) {
  const std::vector<double> as_it_is = table.distance;
  for (const unsigned threads : {1u, 4u}) {
    set_threads(threads);
    table::add_distance(table, law, data);
    EXPECT_EQ(table.distance, as_it_is);
  }
  set_threads(0);
}

TEST_F(TableDistance, IsNoPartOfTheDirectForm) {
  EXPECT_TRUE(table::direct_form(law, table).distance.empty());
}

TEST_F(TableDistance, ShareThatIsNoneIsAFaultOfTheFile) {
  const test::TemporaryDirectory directory;
  table.record.share_far = 1.5;
  write_table(table, directory.path("t.h5"));
  EXPECT_THAT([&] { table::read_table(directory.path("t.h5")); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("share_far is 1.5")));
}

TEST(TableDistanceOfNoAxes, IsNone) {
  const models::AssembledLaw law(test::plausible_model(*models::find_law("orowan")));
  const data::Dataset data = test::sample_data(law.model);
  Table table = table::build_table(law, table::state_ranges(law, data, {}), {});
  table::add_distance(table, law, data);
  EXPECT_TRUE(table.distance.empty());
  EXPECT_EQ(table::distance_text(table), "");
}

} // namespace
} // namespace frictab::distance_test
