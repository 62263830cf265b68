// The linear model of ln mu over states.
#include "process/smooth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Cholesky>

#include "calibrate/network.h"
#include "calibrate/polynomial_fit.h"
#include "data/condense.h"
#include "data/quantity.h"
#include "models/law.h"

namespace frictab::process {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using models::PolynomialState;

namespace {

// Least standard deviation by order of term: that of examples/01_synthetic_campaign (synthetic).
// Tests in a narrow range show no curvature, but a process in a wider one may have it.
constexpr double usual_spread[] = {0.139, 0.0184, 0.0032};

// Bumps: how many, how wide in scaled states (which run from -1 to 1), how high in ln mu.
constexpr Index most_bumps = 40;
constexpr double bump_width = 0.3, bump_spread = 0.1;

const calibrate::PolynomialRecord* record_of(const calibrate::Calibration& calibration) {
  for (const calibrate::ModelFit& fit : calibration.fits)
    if (const auto& record = fit.delivered().polynomial) return &*record;
  return nullptr;
}

// Logarithms but of temperatures and of states that reach zero.
PolynomialState scaled_state(const std::string& name, const std::pair<double, double>& range,
                             double offset) {
  PolynomialState state{.name = name, .low = range.first, .high = range.second};
  state.log = data::find_quantity(name)->unit != "degC" && range.first >= 0;
  if (state.log && !(state.low > 0)) state.offset = offset;
  const double low = state.u(state.low), high = state.u(state.high);
  state.centre = 0.5 * (low + high);
  state.half = 0.5 * (high - low);
  return state;
}

// A twentieth of the positive values lie below it.
double small_value(std::span<const double> values) {
  std::vector<double> positive;
  std::ranges::copy_if(values, std::back_inserter(positive), [](double x) { return x > 0; });
  if (positive.empty()) return 1;
  const auto at = positive.begin() + static_cast<std::ptrdiff_t>(positive.size() / 20);
  std::nth_element(positive.begin(), at, positive.end());
  return *at;
}

} // namespace

Smooth::Smooth(const calibrate::Calibration& calibration, const data::Dataset& tests,
               std::vector<std::string> names, const StateRanges& ranges) {
  std::vector<double> wider; // per state: its range over that of the tests
  const StateRanges tested = ranges_of(tests, names);
  for (std::size_t s = 0; s < names.size(); ++s) {
    const double small = small_value(tests.values(names[s]));
    states_.push_back(scaled_state(names[s], ranges[s], small));
    wider.push_back(states_.back().half / scaled_state(names[s], tested[s], small).half);
  }
  const calibrate::PolynomialRecord* record = record_of(calibration);
  terms_ = models::polynomial_terms(names.size(), models::highest_degree);
  prior_.resize(static_cast<Index>(terms_.size()) + 1);
  prior_(0) = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < terms_.size(); ++t) {
    const unsigned order = std::accumulate(terms_[t].begin(), terms_[t].end(), 0U);
    double spread = usual_spread[order - 1];
    if (record && order <= record->spread.size())
      spread = std::max(spread, record->spread[order - 1]);
    for (std::size_t s = 0; s < names.size(); ++s)
      spread *= std::pow(wider[s], terms_[t][s]);
    prior_(static_cast<Index>(t) + 1) = spread * spread;
  }
  const VectorXd position =
      VectorXd::LinSpaced(bins_of_a_test, 0.5 / bins_of_a_test - 0.5, 0.5 - 0.5 / bins_of_a_test);
  const calibrate::PolynomialNoise noise = record ? record->noise : calibrate::PolynomialNoise{};
  weight_ = calibrate::bin_covariance(noise, position, VectorXd::Ones(bins_of_a_test))
                .llt()
                .solve(MatrixXd::Identity(bins_of_a_test, bins_of_a_test));
}

MatrixXd Smooth::scaled(const States& states) const {
  const auto rows = static_cast<Index>(states.empty() ? 0 : states.front().size());
  MatrixXd z(static_cast<Index>(states_.size()), rows);
  for (std::size_t s = 0; s < states_.size(); ++s)
    for (Index i = 0; i < rows; ++i)
      z(static_cast<Index>(s), i) = states_[s].z(states[s][static_cast<std::size_t>(i)]);
  return z;
}

void Smooth::add_bumps(const States& states) {
  const MatrixXd z = scaled(states);
  const Index count = std::min(most_bumps, z.cols());
  bumps_.resize(z.rows(), count);
  for (Index b = 0; b < count; ++b)
    bumps_.col(b) = z.col((2 * b + 1) * z.cols() / (2 * count));
  const Index before = prior_.size();
  prior_.conservativeResize(before + count);
  prior_.tail(count).setConstant(bump_spread * bump_spread);
}

MatrixXd Smooth::design(const States& states) const {
  const MatrixXd z = scaled(states);
  // Legendre polynomials of each state, by degree.
  std::vector<std::array<VectorXd, models::highest_degree + 1>> p(states_.size());
  for (std::size_t s = 0; s < states_.size(); ++s)
    for (unsigned degree = 0; degree <= models::highest_degree; ++degree)
      p[s][degree] = z.row(static_cast<Index>(s)).unaryExpr([&](double x) {
        return models::legendre(degree, x);
      });
  MatrixXd out = MatrixXd::Ones(z.cols(), terms());
  for (std::size_t t = 0; t < terms_.size(); ++t)
    for (std::size_t s = 0; s < states_.size(); ++s)
      if (terms_[t][s] > 0)
        out.col(static_cast<Index>(t) + 1).array() *= p[s][terms_[t][s]].array();
  for (Index b = 0; b < bumps_.cols(); ++b)
    out.col(out.cols() - bumps_.cols() + b) =
        (-(z.colwise() - bumps_.col(b)).colwise().squaredNorm() / (2 * bump_width * bump_width))
            .array()
            .exp()
            .transpose();
  return out;
}

MatrixXd Smooth::bins(const MatrixXd& design) const {
  MatrixXd means(bins_of_a_test, design.cols());
  for (Index b = 0; b < bins_of_a_test; ++b) {
    const Index from = b * design.rows() / bins_of_a_test,
                to = std::max((b + 1) * design.rows() / bins_of_a_test, from + 1);
    const Index first = std::min(from, design.rows() - 1);
    means.row(b) = design.middleRows(first, std::min(to, design.rows()) - first).colwise().mean();
  }
  return means;
}

std::vector<std::string> smooth_states(const data::Dataset& tests) {
  return calibrate::network_inputs(*models::find_law("polynomial"), tests);
}

StateRanges ranges_of(const data::Dataset& data, std::span<const std::string> names) {
  StateRanges ranges;
  for (const std::string& name : names)
    ranges.push_back(data::source_range(data, name, data.values(name)));
  return ranges;
}

std::vector<std::size_t> some_rows(std::size_t first, std::size_t end, std::size_t most) {
  const std::size_t rows = end - first, kept = std::min(rows, most);
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < kept; ++i)
    at.push_back(first + (2 * i + 1) * rows / (2 * kept));
  return at;
}

States states_at(const data::Dataset& data, std::span<const std::string> names,
                 std::span<const std::size_t> rows) {
  States states;
  for (const std::string& name : names) {
    const auto values = data.values(name);
    std::vector<double>& column = states.emplace_back();
    for (const std::size_t row : rows)
      column.push_back(values[row]);
  }
  return states;
}

} // namespace frictab::process
