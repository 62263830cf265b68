// Training of the neural network, from rows to an ensemble.
#include "calibrate/network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "calibrate/folds.h"
#include "calibrate/network_fit.h"
#include "core/names.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/random.h"
#include "data/condense.h"
#include "data/quantity.h"
#include "data/shares.h"

namespace frictab::calibrate {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t hidden_units = 8, repeats = 4, most_folds = 5;
// More bins do not improve accuracy: rows closer than this are alike.
constexpr std::size_t bins_per_experiment = 11;
// In units of the noise; the chosen one has always been well inside this range.
const std::vector<double> decays{100, 30, 10, 3, 1, 0.3};

// Means of a column over the bins of each experiment.
struct Binning {
  std::vector<std::size_t> first; // first row of each bin; last, the number of rows
  std::vector<Index> first_bin;   // first bin of each experiment; last, the number of bins

  const data::Dataset& data;

  explicit Binning(const data::Dataset& of) : first_bin{0}, data(of) {
    for (std::size_t e = 0; e < data.experiments.size(); ++e) {
      const std::vector<std::size_t> bins = data::equal_shares(data, e, bins_per_experiment);
      first.insert(first.end(), bins.begin(), bins.end() - 1);
      first_bin.push_back(first.size());
    }
    first.push_back(data.rows());
  }

  VectorXd means(std::span<const double> column) const {
    VectorXd mean(first_bin.back());
    for (std::size_t b = 0; b + 1 < first.size(); ++b) {
      double sum = 0;
      for (std::size_t i = first[b]; i < first[b + 1]; ++i)
        sum += data.row_weight(i) * column[i];
      mean(b) = sum / rows_in(b);
    }
    return mean;
  }

  double rows_in(std::size_t b) const {
    double rows = 0;
    for (std::size_t i = first[b]; i < first[b + 1]; ++i)
      rows += data.row_weight(i);
    return rows;
  }

  VectorXd weights() const {
    VectorXd rows(first_bin.back());
    for (std::size_t b = 0; b + 1 < first.size(); ++b)
      rows(b) = rows_in(b);
    return (rows / rows.mean()).cwiseSqrt();
  }
};

models::NetworkInput scaling(const std::string& name, double smallest, const VectorXd& bins) {
  models::NetworkInput input{.name = name};
  const double low = bins.minCoeff(), high = bins.maxCoeff();
  // Degrees Celsius have an arbitrary zero, so decades are meaningless.
  input.log =
      data::find_quantity(name)->unit != "degC" && smallest >= 0 && low > 0 && high >= 10 * low;
  if (input.log) {
    input.offset = low - smallest;
    input.floor = input.offset > 0 ? 0 : 1e-3 * low;
  }
  const VectorXd u = bins.unaryExpr([&](double x) { return input.u(x); });
  input.centre = u.mean();
  const double spread = std::sqrt((u.array() - input.centre).square().mean());
  input.scale = spread > 1e-9 * std::abs(input.centre) ? spread : 1; // it varies inside bins only
  return input;
}

struct TrainingSet {
  data::Units units; // units that folds keep together
  std::vector<models::NetworkInput> inputs;
  NetworkBins bins;
  NetworkShape shape;
  double mu0 = 0; // Coulomb's least squares; 0 without load
};

TrainingSet prepare(const models::Law& law, const data::Dataset& data,
                    const models::Conventions& conventions) {
  const Binning binning(data);
  TrainingSet set;
  set.units = data::units_of(data);
  NetworkBins& bins = set.bins;
  bins.first = binning.first_bin;
  bins.weight = binning.weights();
  bins.stress = binning.means(data.values("sigma_n_MPa"));
  bins.measured = binning.means(data.values("tau_R_MPa"));
  bins.limit =
      conventions.shear_limit
          ? VectorXd(conventions.k_over_sigma_f * binning.means(data.values("sigma_f_MPa")))
          : VectorXd::Constant(bins.stress.size(), std::numeric_limits<double>::infinity());
  const auto names = network_inputs(law, data);
  bins.z.resize(bins.stress.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const VectorXd mean = binning.means(data.values(names[i]));
    const double smallest = data::source_range(data, names[i], data.values(names[i])).first;
    set.inputs.push_back(scaling(names[i], smallest, mean));
    bins.z.col(i) = mean.unaryExpr([&](double x) { return set.inputs.back().z(x); });
  }
  set.shape = {names.size(), hidden_units};
  const VectorXd force = bins.weight.cwiseProduct(bins.stress);
  if (force.squaredNorm() > 0)
    set.mu0 = force.dot(bins.weight.cwiseProduct(bins.measured)) / force.squaredNorm();
  return set;
}

// Random weights differ between units, and are small at the output, so that the first net is nearly
// Coulomb.
VectorXd random_weights(const NetworkShape& shape, Random random) {
  VectorXd w(shape.weights());
  Index at = 0;
  const double inputs = static_cast<double>(shape.inputs);
  for (std::size_t h = 0; h < shape.hidden; ++h) {
    for (std::size_t i = 0; i < shape.inputs; ++i)
      w(at++) = random.normal() / std::sqrt(inputs);
    w(at++) = 0.5 * random.normal();
    w(at++) = 0.1 * random.normal() / std::sqrt(static_cast<double>(shape.hidden));
  }
  w(at) = 0;
  return w;
}

// Training and held-out experiments of one fold.
struct Fold {
  NetworkBins training, held_out;
};

Fold make_fold(const NetworkBins& bins, const std::vector<std::size_t>& fold_of, std::size_t fold) {
  const FoldParts parts = parts_of(fold_of, fold);
  return {bins.of(parts.in), bins.of(parts.out)};
}

class Training {
public:
  Training(const TrainingSet& set, std::uint64_t seed)
      : set_(set), seed_(seed), folds_(std::min(most_folds, set.units.count)) {}

  std::size_t folds() const { return folds_; }

  // Fits one net per decay of the path, each started from the previous one.
  std::vector<NetworkFit> path(std::size_t repeat, std::size_t fold, NetworkScatter scatter,
                               const std::vector<double>& path_decays) const {
    const auto fold_of = experiment_folds(set_.units, folds_, seed_, repeat);
    const Fold part = make_fold(set_.bins, fold_of, fold);
    VectorXd start = random_weights(set_.shape, Random(seed_, (repeat << 8) + fold + 0x6e6574));
    std::vector<NetworkFit> fits;
    for (const double decay : path_decays) {
      fits.push_back(
          fit_network({part.training, part.held_out, set_.shape, set_.mu0, scatter, decay}, start));
      start = fits.back().last;
    }
    return fits;
  }

  // Trains all folds of `count` repeats, sorted by repeat and fold.
  std::vector<std::vector<NetworkFit>> all_paths(std::size_t count, NetworkScatter scatter,
                                                 const std::vector<double>& path_decays) const {
    std::vector<std::vector<NetworkFit>> paths(count * folds_);
    const Progress progress("training networks", paths.size());
    parallel_for(paths.size(), [&](std::size_t i) {
      paths[i] = path(i / folds_, i % folds_, scatter, path_decays);
      progress.tick();
    });
    return paths;
  }

  // Estimates variance components of the residuals of held-out experiments (method of moments),
  // from nets trained without them.
  NetworkScatter scatter() const {
    const VectorXd coulomb = network_residual(set_.bins, set_.mu0 * set_.bins.stress);
    const double rms = std::sqrt(coulomb.squaredNorm() / static_cast<double>(coulomb.size()));
    if (!(rms > 0)) return {1, 0};
    const auto paths = all_paths(1, {rms / 2, 0}, {3});
    const auto fold_of = experiment_folds(set_.units, folds_, seed_, 0);
    double within = 0, gain_square = 0, freedom = 0;
    std::vector<std::pair<double, double>> gains; // along the gain: residual, reach
    for (std::size_t f = 0; f < folds_; ++f) {
      const NetworkBins bins = make_fold(set_.bins, fold_of, f).held_out;
      const VectorXd r =
          network_residual(bins, network_tau(bins, set_.shape, set_.mu0, paths[f][0].weights));
      const GainDirection direction = gain_direction(bins, set_.mu0);
      for (std::size_t e = 0; e < bins.experiments(); ++e) {
        const Index at = bins.first[e], count = bins.first[e + 1] - at;
        const double along = direction.unit.segment(at, count).dot(r.segment(at, count));
        within += r.segment(at, count).squaredNorm() - along * along;
        freedom += static_cast<double>(count) - 1;
        gains.emplace_back(along, direction.reach(e));
      }
    }
    const double noise_square = freedom > 0 ? within / freedom : rms * rms;
    for (const auto& [along, reach] : gains)
      if (reach > 0)
        gain_square +=
            (along * along - noise_square) / (reach * reach) / static_cast<double>(gains.size());
    return {std::max(std::sqrt(noise_square), 1e-6 * rms), std::sqrt(std::max(0.0, gain_square))};
  }

  // Ratio of measured to predicted stress (least squares) of each experiment, predicted by the nets
  // that did not see it. Uses their last iteration, because the best one was selected by the
  // experiment.
  std::vector<double> held_out_gains(const std::vector<std::vector<NetworkFit>>& paths,
                                     std::size_t decay) const {
    const NetworkBins& bins = set_.bins;
    VectorXd tau = VectorXd::Zero(bins.stress.size());
    for (std::size_t r = 0; r < paths.size() / folds_; ++r) {
      const auto fold_of = experiment_folds(set_.units, folds_, seed_, r);
      for (std::size_t e = 0; e < bins.experiments(); ++e) {
        const NetworkBins one = bins.of(std::array{e});
        tau.segment(bins.first[e], one.stress.size()) +=
            network_tau(one, set_.shape, set_.mu0, paths[r * folds_ + fold_of[e]][decay].last);
      }
    }
    tau *= static_cast<double>(folds_) / static_cast<double>(paths.size());
    const VectorXd predicted = bins.weight.cwiseProduct(tau);
    const VectorXd measured = bins.weight.cwiseProduct(bins.measured);
    std::vector<double> gains;
    for (std::size_t e = 0; e < bins.experiments(); ++e) {
      const Index at = bins.first[e], count = bins.first[e + 1] - at;
      gains.push_back(predicted.segment(at, count).dot(measured.segment(at, count)) /
                      predicted.segment(at, count).squaredNorm());
    }
    return gains;
  }

private:
  const TrainingSet& set_;
  std::uint64_t seed_;
  std::size_t folds_;
};

// Removes failed nets, which stand out on all experiments together. Their held-out experiments
// alone do not suffice: one unusual experiment would exclude every net that did not see it.
std::vector<VectorXd> without_failed(const TrainingSet& set, std::vector<VectorXd> members) {
  std::vector<double> squares;
  for (const VectorXd& w : members)
    squares.push_back(
        network_residual(set.bins, network_tau(set.bins, set.shape, set.mu0, w)).squaredNorm());
  std::vector<double> sorted = squares;
  std::ranges::sort(sorted);
  const double most = 4 * sorted[sorted.size() / 2];
  std::size_t kept = 0;
  for (std::size_t m = 0; m < members.size(); ++m)
    if (squares[m] <= most) members[kept++] = members[m];
  members.resize(kept);
  return members;
}

double ensemble_spread(const TrainingSet& set, const std::vector<VectorXd>& members) {
  Eigen::MatrixXd tau(set.bins.stress.size(), members.size());
  for (std::size_t m = 0; m < members.size(); ++m)
    tau.col(m) = network_tau(set.bins, set.shape, set.mu0, members[m]);
  const VectorXd mean = tau.rowwise().mean();
  const double freedom = std::max(1.0, static_cast<double>(members.size()) - 1);
  return ((tau.colwise() - mean).rowwise().squaredNorm() / freedom).cwiseSqrt().mean();
}

// Root mean square error on the bins of held-out experiments, per decay.
std::vector<double> held_out_rmse(const std::vector<std::vector<NetworkFit>>& paths) {
  std::vector<double> rmse;
  for (std::size_t d = 0; d < decays.size(); ++d) {
    double sum = 0;
    for (const auto& path : paths)
      sum += path[d].held_out_square;
    rmse.push_back(std::sqrt(sum / static_cast<double>(paths.size())));
  }
  return rmse;
}

NetworkRecord describe(const TrainingSet& set, const std::vector<VectorXd>& members) {
  NetworkRecord record;
  record.inputs = all_names(set.inputs);
  record.hidden = hidden_units;
  record.members = members.size();
  record.weights = static_cast<std::size_t>(set.shape.weights());
  record.bins = static_cast<std::size_t>(set.bins.stress.size());
  record.spread_MPa = ensemble_spread(set, members);
  return record;
}

} // namespace

std::vector<std::string> network_inputs(const models::Law& law, const data::Dataset& data) {
  std::vector<std::string> names;
  for (const std::string& name : law.may_use) {
    if (!data.has(name)) continue;
    const auto values = data.values(name);
    const auto [low, high] = std::ranges::minmax_element(values);
    if (*low < *high) names.push_back(name);
  }
  return names;
}

std::string network_size(const NetworkRecord& record) {
  return fmt::format("{} nets of {} weights", record.members, record.weights);
}

TrainedNetwork train_network(const models::Law& law, const data::Dataset& training,
                             const models::Conventions& conventions, std::uint64_t seed) {
  const TrainingSet set = prepare(law, training, conventions);
  const Training nets(set, seed);
  const NetworkScatter scatter = nets.scatter();
  const auto paths = nets.all_paths(repeats, scatter, decays);

  const std::vector<double> cv_rmse = held_out_rmse(paths);
  const auto best = static_cast<std::size_t>(std::ranges::min_element(cv_rmse) - cv_rmse.begin());
  std::vector<VectorXd> members;
  for (const auto& path : paths)
    members.push_back(path[best].weights);
  members = without_failed(set, std::move(members));
  models::Network network{set.inputs, hidden_units, {}};
  for (const VectorXd& w : members)
    network.members.emplace_back(w.begin(), w.end());

  NetworkRecord record = describe(set, members);
  record.dropped = paths.size() - members.size();
  record.folds = nets.folds();
  record.repeats = repeats;
  record.decays = decays;
  record.cv_rmse_MPa = cv_rmse;
  record.decay = decays[best];
  record.noise_MPa = scatter.noise_MPa;
  record.gain = scatter.gain;
  record.nets = paths.size() * decays.size() + nets.folds();
  for (const auto& path : paths)
    for (const NetworkFit& fit : path)
      record.iterations += fit.iterations;
  return {models::neural_network(network), set.mu0, nets.held_out_gains(paths, best),
          std::move(record)};
}

} // namespace frictab::calibrate
