// Columns as one value per test, and the simple shapes in which a gain may follow them.
#include "trace/test_shapes.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace frictab::trace {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::size_t different(const VectorXd& x) {
  return std::set<double>(x.begin(), x.end()).size();
}

double median_of(VectorXd x) {
  const auto middle = x.begin() + x.size() / 2;
  std::nth_element(x.begin(), middle, x.end());
  return *middle;
}

VectorXd standardised(const VectorXd& x) {
  const VectorXd centred = x.array() - x.mean();
  const double size = centred.norm() / std::sqrt(static_cast<double>(x.size()));
  return size > 0 ? VectorXd(centred / size) : centred;
}

void add_number(const Cause& cause, const VectorXd& x, std::vector<TestShape>& shapes) {
  if (different(x) < 2) return;
  shapes.push_back({cause, "line", standardised(x)});
  if (different(x) > 2 && x.minCoeff() > 0 && x.maxCoeff() > 1.5 * x.minCoeff())
    shapes.push_back({cause, "log", standardised(x.array().log().matrix())});
  if (different(x) <= 4) return;
  const double middle = median_of(x);
  shapes.push_back({cause, "above", (x.array() - middle).max(0.0).matrix()});
  shapes.push_back({cause, "below", (middle - x.array()).max(0.0).matrix()});
  if (x.minCoeff() == 0 && middle > 0)
    shapes.push_back({cause, "log1p", (1 + x.array() / middle).log().matrix()});
}

// A level of one test joins the rest. Levels against each other, and each against the rest.
void add_text(const Cause& cause, const VectorXd& x, std::size_t levels,
              std::vector<TestShape>& shapes) {
  std::vector<VectorXd> is;
  std::size_t seen = 0;
  for (std::size_t level = 0; level < levels; ++level) {
    const VectorXd here = (x.array() == static_cast<double>(level)).cast<double>();
    seen += here.sum() > 0;
    if (here.sum() >= 2) is.push_back(here);
  }
  if (is.empty() || seen < 2 || static_cast<Index>(seen) >= x.size()) return;
  const std::size_t left_out = is.size() == seen ? 1 : 0; // the others' mirror image
  MatrixXd all(x.size(), static_cast<Index>(is.size() - left_out));
  for (std::size_t i = left_out; i < is.size(); ++i)
    all.col(static_cast<Index>(i - left_out)) = is[i];
  shapes.push_back({cause, "levels", all});
  if (seen > 2)
    for (const VectorXd& one : is)
      shapes.push_back({cause, "one level", one});
}

} // namespace

std::vector<TestShape> test_shapes(const Candidates& candidates, const Blocks& blocks) {
  std::vector<TestShape> shapes;
  for (std::size_t c = 0; c < candidates.columns.size(); ++c) {
    const CandidateColumn& column = candidates.columns[c];
    if (!column.between) continue;
    if (!column.levels.empty() && column.within) continue;
    const VectorXd x = blocks.experiment_means(column.values).col(0);
    if (column.levels.empty())
      add_number({{c}}, x, shapes);
    else
      add_text({{c}}, x, column.levels.size(), shapes);
  }
  return shapes;
}

} // namespace frictab::trace
