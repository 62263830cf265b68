// Finds the rows of tests nearest to a state, by a k-d tree.
#include "table/distance.h"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>

#include <fmt/format.h>

#include "calibrate/input_columns.h"
#include "core/parallel.h"
#include "core/random.h"
#include "table/sampling.h"

namespace frictab::table {

namespace {

constexpr std::size_t rows_of_a_test = 64;
// So many rows are always enough: each counts at least 1/64 of a test.
constexpr auto most_rows = static_cast<std::size_t>(enough_tests * rows_of_a_test);
constexpr std::size_t share_points = 4096;

// Scale of one axis: (u - low)/span, u its coordinate.
struct Scale {
  bool log = false;
  double low = 0, span = 1;
  double operator()(double x) const { return ((log ? std::log(x) : x) - low) / span; }
};

Scale scale_of(const TableAxis& axis, std::span<const double> values) {
  Scale scale{axis.log, 0, 1};
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const double value : values)
    if (const double u = scale(value); std::isfinite(u)) {
      low = std::min(low, u);
      high = std::max(high, u);
    }
  scale.low = low;
  if (high > low)
    scale.span = high - low;
  else if (!axis.log && std::abs(low) > 0)
    scale.span = std::abs(low);
  return scale;
}

// Interface that nanoflann requires of a point set.
struct Points {
  std::size_t dims = 0;
  std::vector<double> at; // dims numbers each
  std::size_t kdtree_get_point_count() const { return at.size() / dims; }
  double kdtree_get_pt(std::size_t i, std::size_t d) const { return at[i * dims + d]; }
  template <class Box> bool kdtree_get_bbox(Box&) const { return false; }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Adaptor<double, Points>, Points, -1>;

struct PointsOfTests {
  Points points;
  std::vector<double> weight; // share of its test, per point
};

PointsOfTests points_of(const std::vector<Scale>& scales,
                        const std::vector<std::span<const double>>& columns,
                        std::span<const std::size_t> first_row) {
  PointsOfTests all{{scales.size(), {}}, {}};
  std::vector<double> u(scales.size());
  for (std::size_t test = 0; test + 1 < first_row.size(); ++test) {
    const std::size_t rows = first_row[test + 1] - first_row[test];
    const std::size_t kept = std::min(rows, rows_of_a_test);
    for (std::size_t i = 0; i < kept; ++i) {
      const std::size_t row = first_row[test] + (2 * i + 1) * rows / (2 * kept);
      for (std::size_t a = 0; a < u.size(); ++a)
        u[a] = scales[a](columns[a][row]);
      if (!std::ranges::all_of(u, [](double x) { return std::isfinite(x); })) continue;
      all.points.at.insert(all.points.at.end(), u.begin(), u.end());
      all.weight.push_back(1 / static_cast<double>(kept));
    }
  }
  return all;
}

} // namespace

struct TestRows::Data {
  std::vector<TableAxis> axes;
  std::vector<Scale> scales;
  PointsOfTests tests;
  std::unique_ptr<Tree> tree; // null without points

  double far(const std::vector<double>& u) const {
    if (!tree || !std::ranges::all_of(u, [](double x) { return std::isfinite(x); }))
      return HUGE_VAL;
    unsigned index[most_rows];
    double squared[most_rows];
    const std::size_t found = tree->knnSearch(u.data(), most_rows, index, squared);
    double near = 0;
    for (std::size_t i = 0; i < found; ++i) {
      near += tests.weight[index[i]];
      if (near >= enough_tests * (1 - 1e-9)) return std::sqrt(squared[i]);
    }
    return HUGE_VAL;
  }
};

TestRows::TestRows(std::vector<TableAxis> axes, const std::vector<std::span<const double>>& columns,
                   std::span<const std::size_t> first_row)
    : data_(std::make_unique<Data>()) {
  for (std::size_t a = 0; a < axes.size(); ++a)
    data_->scales.push_back(scale_of(axes[a], columns[a]));
  data_->axes = std::move(axes);
  data_->tests = points_of(data_->scales, columns, first_row);
  const Points& points = data_->tests.points;
  if (!points.at.empty()) data_->tree = std::make_unique<Tree>(points.dims, points);
}

TestRows::~TestRows() = default;

bool TestRows::empty() const {
  return data_->tree == nullptr;
}

double TestRows::distance(std::span<const double> state) const {
  std::vector<double> u(state.size());
  for (std::size_t a = 0; a < u.size(); ++a)
    u[a] = data_->scales[a](state[a]);
  return data_->far(u);
}

double TestRows::share_far() const {
  const std::size_t dims = data_->axes.size();
  std::vector<double> u(dims);
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < share_points; ++i) {
    halton(i, u);
    for (std::size_t a = 0; a < dims; ++a) {
      const std::vector<double>& nodes = data_->axes[a].nodes;
      const double low = data_->scales[a](nodes.front()), high = data_->scales[a](nodes.back());
      u[a] = low + u[a] * (high - low);
    }
    beyond += data_->far(u) > far_from_tests;
  }
  return static_cast<double>(beyond) / static_cast<double>(share_points);
}

namespace {

std::vector<double> at_nodes(const Table& table, const TestRows& rows) {
  std::vector<double> distances(table.nodes());
  parallel_for((distances.size() + sample_block - 1) / sample_block, [&](std::size_t block) {
    const std::size_t end = std::min(distances.size(), (block + 1) * sample_block);
    for (std::size_t i = block * sample_block; i < end; ++i)
      distances[i] = rows.distance(values_at(table.axes, i));
  });
  return distances;
}

} // namespace

void add_distance(Table& table, const models::AssembledLaw& law, const data::Dataset& data) {
  if (table.axes.empty()) return;
  const calibrate::InputColumns inputs = calibrate::input_columns(law, law.inputs, data);
  std::vector<std::span<const double>> columns;
  for (const TableAxis& axis : table.axes)
    for (std::size_t i = 0; i < inputs.names().size(); ++i)
      if (inputs.names()[i] == axis.name) columns.push_back(inputs[i]);
  const TestRows rows(table.axes, columns, data.first_row);
  if (rows.empty()) return;
  table.distance = at_nodes(table, rows);
  table.record.share_far = rows.share_far();
}

std::string distance_text(const Table& table) {
  if (!table.record.share_far) return "";
  return fmt::format("{:.0f} % of the table extrapolates: less than half a test within 1/4 of the "
                     "measured spans",
                     100 * *table.record.share_far);
}

} // namespace frictab::table
