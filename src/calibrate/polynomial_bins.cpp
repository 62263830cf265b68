// Cuts experiments into bins by their states.
#include "calibrate/polynomial_bins.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "data/condense.h"
#include "data/middle.h"
#include "data/quantity.h"

namespace frictab::calibrate {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using models::PolynomialState;

namespace {

// Fewer bins blur the run-in, more repeat information: errors with 7, 9 and 12 agree within 0.4 %.
constexpr std::size_t bins_of_an_experiment = 9;
// With more rows, those between two edges stay together. Scatter from row to row, which is averaged
// in condensed rows, then does not decide any cut.
constexpr std::size_t cells_of_an_experiment = 880;
// Fraction of the median coefficient of all bins; smaller values are noise around zero, which a
// logarithm would amplify.
constexpr double least_share = 0.02;
// Distance beyond its outermost bins over which a state is followed, as a share of their range.
constexpr double beyond_bins = 0.1;

// Value exceeded by 95 % of the positive values; 0 if there are none.
double exceeded_by_most(const data::Dataset& data, std::span<const double> rows) {
  std::vector<std::pair<double, double>> positive; // with the number of rows that each represents
  double all = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i] > 0) {
      positive.emplace_back(rows[i], data.row_weight(i));
      all += data.row_weight(i);
    }
  if (!data.condensed && !positive.empty()) { // no need to sort them
    const auto small = positive.begin() + positive.size() / 20;
    std::nth_element(positive.begin(), small, positive.end());
    return small->first;
  }
  std::ranges::sort(positive);
  double below = std::floor(all / 20);
  for (const auto& [value, weight] : positive) {
    if (weight > below) return value;
    below -= weight;
  }
  return 0;
}

// Chooses the coordinate of a state: its logarithm or, if it (nearly) reaches zero, that of x +
// offset, where the offset is exceeded by 95 % of its positive values. Degrees Celsius have an
// arbitrary zero, so decades are meaningless, and a signed state has no logarithm.
PolynomialState coordinate(const std::string& name, const data::Dataset& data) {
  PolynomialState state{.name = name};
  const auto rows = data.values(name);
  std::tie(state.low, state.high) = data::source_range(data, name, rows);
  if (data::find_quantity(name)->unit == "degC" || state.low < 0) return state;
  const double small = exceeded_by_most(data, rows);
  state.log = true;
  if (state.low < 0.1 * small) state.offset = small;
  return state;
}

// Number of source rows before each row; last, their total.
std::vector<double> rows_before(const data::Dataset& data) {
  std::vector<double> before{0};
  for (std::size_t i = 0; i < data.rows(); ++i)
    before.push_back(before.back() + data.row_weight(i));
  return before;
}

// Positions at which experiments may be cut.
struct Cells {
  std::vector<Index> edges; // first row of each cell; last, the number of rows
  std::vector<Index> first; // first edge of each experiment; last, the last edge
  std::vector<double> rows; // source rows before each edge
  MatrixXd sums;            // of the standardised states over the source rows, edges x states

  double rows_in(Index from, Index to) const {
    return rows[static_cast<std::size_t>(to)] - rows[static_cast<std::size_t>(from)];
  }
};

// Adds edges that divide the rows of each experiment evenly; with few rows, an edge at every row.
void add_edges(Cells& cells, const data::Dataset& data, const std::vector<double>& before) {
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const std::size_t begin = data.first_row[e], end = data.first_row[e + 1];
    const std::size_t count = std::min(end - begin, cells_of_an_experiment);
    cells.first.push_back(cells.edges.size());
    std::size_t at = begin;
    for (std::size_t c = 0; c < count; ++c) {
      const double share = static_cast<double>(c) / static_cast<double>(count);
      const double wanted = before[begin] + share * (before[end] - before[begin]);
      if (count == end - begin)
        at = begin + c;
      else
        while (at + 1 < end && 0.5 * (before[at] + before[at + 1]) < wanted) // blocks may be long
          ++at;
      const Index edge = at;
      if (c == 0 || edge > cells.edges.back()) cells.edges.push_back(edge);
    }
  }
  cells.first.push_back(cells.edges.size());
  cells.edges.push_back(data.rows());
  for (const Index edge : cells.edges)
    cells.rows.push_back(before[static_cast<std::size_t>(edge)]);
}

// Standardises by mean and standard deviation of the cells' means.
void standardise(Eigen::Ref<VectorXd> sums, const Cells& cells) {
  const Index count = sums.size() - 1;
  if (count == 0) return;
  const double all = cells.rows.back(), mean = sums(count) / all;
  double variance = 0;
  for (Index c = 0; c < count; ++c) {
    const double rows = cells.rows_in(c, c + 1);
    const double from_mean = (sums(c + 1) - sums(c)) / rows - mean;
    variance += rows * from_mean * from_mean / all;
  }
  for (Index c = 0; c <= count; ++c)
    sums(c) -= mean * cells.rows[static_cast<std::size_t>(c)];
  if (variance > 0) sums /= std::sqrt(variance);
}

// u: the states of the rows, rows x states.
Cells cells_of(const data::Dataset& data, const MatrixXd& u) {
  Cells cells;
  add_edges(cells, data, rows_before(data));
  const Index edges = cells.edges.size();
  cells.sums.resize(edges, u.cols());
  for (Index state = 0; state < u.cols(); ++state) {
    double sum = 0;
    Index row = 0;
    for (Index i = 0; i < edges; ++i) {
      for (; row < cells.edges[static_cast<std::size_t>(i)]; ++row)
        sum += data.row_weight(static_cast<std::size_t>(row)) * u(row, state);
      cells.sums(i, state) = sum;
    }
    standardise(cells.sums.col(state), cells);
  }
  return cells;
}

// Tree of the cuts of one experiment, as edges of its cells.
class StateTree {
public:
  explicit StateTree(const Cells& cells) : cells_(cells), sums_(cells.sums) {}

  std::vector<Index> cuts(Index from, Index to) const {
    std::vector<Part> parts{best_cut(from, to)};
    while (parts.size() < bins_of_an_experiment) {
      const auto widest = std::ranges::max_element(parts, {}, &Part::gain);
      if (widest->cut < 0) break;
      const Part whole = *widest;
      *widest = best_cut(whole.from, whole.cut);
      parts.insert(widest + 1, best_cut(whole.cut, whole.to));
    }
    std::vector<Index> cuts;
    for (const Part& part : parts)
      cuts.push_back(part.from);
    cuts.push_back(to);
    return cuts;
  }

private:
  struct Part {
    Index from, to;
    Index cut = -1;   // -1: a single cell
    double gain = -1; // reduction of the sum of squares by the cut
  };

  Part best_cut(Index from, Index to) const {
    Part part{from, to};
    for (Index cut = from + 1; cut < to; ++cut) {
      const double left = cells_.rows_in(from, cut), right = cells_.rows_in(cut, to);
      const double gain =
          left * right / (left + right) *
          ((sums_.row(cut) - sums_.row(from)) / left - (sums_.row(to) - sums_.row(cut)) / right)
              .squaredNorm();
      if (gain > part.gain) part = {from, to, cut, gain};
    }
    return part;
  }

  const Cells& cells_;
  const MatrixXd& sums_;
};

struct RowColumns {
  std::span<const double> stress, tau;
  std::span<const double> flow_stress; // empty without the shear limit
  MatrixXd u;                          // rows x states
  const data::Dataset& data;
};

struct BinOfRows {
  double stress = 0, tau = 0, limit = 0, position = 0, rows = 0;
  VectorXd u;
};

// Means over the rows under load; rows = 0 if there are none.
BinOfRows bin_of(const RowColumns& columns, Index from, Index to) {
  BinOfRows bin;
  bin.u = VectorXd::Zero(columns.u.cols());
  for (Index i = from; i < to; ++i) {
    const auto row = static_cast<std::size_t>(i);
    if (!(columns.stress[row] > 0)) continue;
    const double weight = columns.data.row_weight(row);
    bin.rows += weight;
    bin.stress += weight * columns.stress[row];
    bin.tau += weight * columns.tau[row];
    if (!columns.flow_stress.empty()) bin.limit += weight * columns.flow_stress[row];
    bin.u += weight * columns.u.row(i).transpose();
  }
  const double count = std::max(bin.rows, 1.0);
  for (double* sum : {&bin.stress, &bin.tau, &bin.limit})
    *sum /= count;
  bin.u /= count;
  return bin;
}

double median_coefficient(const std::vector<std::vector<BinOfRows>>& bins) {
  std::vector<double> mu;
  for (const auto& experiment : bins)
    for (const BinOfRows& bin : experiment)
      if (bin.tau > 0) mu.push_back(bin.tau / bin.stress);
  return mu.empty() ? 0 : data::upper_median(std::move(mu));
}

std::vector<std::vector<BinOfRows>> cut_experiments(const data::Dataset& data,
                                                    const RowColumns& columns) {
  const Cells cells = cells_of(data, columns.u);
  const StateTree tree(cells);
  std::vector<std::vector<BinOfRows>> bins(data.experiments.size());
  for (std::size_t e = 0; e < bins.size(); ++e) {
    const Index begin = cells.first[e], end = cells.first[e + 1];
    const std::vector<Index> cuts = tree.cuts(begin, end);
    for (std::size_t b = 0; b + 1 < cuts.size(); ++b) {
      const auto row = [&](Index edge) { return cells.edges[static_cast<std::size_t>(edge)]; };
      BinOfRows bin = bin_of(columns, row(cuts[b]), row(cuts[b + 1]));
      bin.position = 0.5 * (cells.rows_in(begin, cuts[b]) + cells.rows_in(begin, cuts[b + 1])) /
                         cells.rows_in(begin, end) -
                     0.5;
      if (bin.rows > 0) bins[e].push_back(std::move(bin));
    }
  }
  return bins;
}

// Scales states by the bins: sets the clamped range, the centre and half the range of each, and
// removes states that vary inside bins only.
void scale_states(PolynomialBins& bins, const MatrixXd& u) {
  std::vector<Index> kept;
  std::vector<PolynomialState> states;
  for (Index i = 0; i < u.cols(); ++i) {
    PolynomialState state = bins.states[static_cast<std::size_t>(i)];
    const double low = u.col(i).minCoeff(), high = u.col(i).maxCoeff();
    if (!(high - low > 1e-9 * (std::abs(low) + std::abs(high)))) continue;
    state.centre = 0.5 * (low + high);
    state.half = 0.5 * (high - low);
    const auto x = [&](double at) { return state.log ? std::exp(at) - state.offset : at; };
    const double margin = beyond_bins * (high - low);
    state.low = std::max(state.low, x(low - margin));
    state.high = std::min(state.high, x(high + margin));
    kept.push_back(i);
    states.push_back(state);
  }
  bins.z.resize(u.rows(), kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i)
    bins.z.col(i) = (u.col(kept[i]).array() - states[i].centre) / states[i].half;
  bins.states = std::move(states);
}

void take_bins(PolynomialBins& bins, const std::vector<std::vector<BinOfRows>>& all,
               double least_mu, bool limited) {
  std::vector<const BinOfRows*> kept;
  bins.first = {0};
  for (const auto& experiment : all) {
    for (const BinOfRows& bin : experiment)
      if (bin.tau > least_mu * bin.stress)
        kept.push_back(&bin);
      else
        ++bins.without_friction;
    if (const Index end = kept.size(); end > bins.first.back()) bins.first.push_back(end);
  }
  const Index count = kept.size();
  for (auto member : {&PolynomialBins::ln_mu, &PolynomialBins::stress, &PolynomialBins::limit,
                      &PolynomialBins::position, &PolynomialBins::rows})
    (bins.*member).resize(count);
  MatrixXd u(count, bins.states.size());
  for (Index b = 0; b < count; ++b) {
    const BinOfRows& bin = *kept[static_cast<std::size_t>(b)];
    bins.ln_mu(b) = std::log(bin.tau / bin.stress);
    bins.stress(b) = bin.stress;
    bins.limit(b) = limited ? bin.limit : std::numeric_limits<double>::infinity();
    bins.position(b) = bin.position;
    bins.rows(b) = bin.rows;
    u.row(b) = bin.u.transpose();
  }
  if (count > 0) scale_states(bins, u);
}

} // namespace

PolynomialBins polynomial_bins(const std::vector<std::string>& names, const data::Dataset& data,
                               const models::Conventions& conventions) {
  PolynomialBins bins;
  RowColumns columns{data.values("sigma_n_MPa"), data.values("tau_R_MPa"), {}, {}, data};
  if (conventions.shear_limit) columns.flow_stress = data.values("sigma_f_MPa");
  columns.u.resize(data.rows(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto rows = data.values(names[i]);
    bins.states.push_back(coordinate(names[i], data));
    for (std::size_t row = 0; row < rows.size(); ++row)
      columns.u(row, i) = bins.states.back().u(rows[row]);
  }
  for (std::size_t row = 0; row < data.rows(); ++row)
    if (!(columns.stress[row] > 0))
      bins.without_load += static_cast<std::size_t>(data.row_weight(row));
  const auto all = cut_experiments(data, columns);
  take_bins(bins, all, least_share * std::max(0.0, median_coefficient(all)),
            conventions.shear_limit);
  if (conventions.shear_limit) bins.limit *= conventions.k_over_sigma_f;
  return bins;
}

} // namespace frictab::calibrate
