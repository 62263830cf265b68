// Base truths, and the base laws fitted to what is measured.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Dense>

#include "foreign/part.h"

namespace frictab::foreign {

namespace {

constexpr double k_over_sigma_f = 0.57735026918962584;

// What mu is linear in.
std::vector<Values> regressors(const std::string& base, const Part& part) {
  const Values& sigma = part.at("sigma_n_MPa");
  std::vector<Values> columns{sigma};
  if (base != "log_coulomb") return columns;
  const std::pair<const char*, double> states[] = {
      {"sigma_n_MPa", 1000}, {"psi", 1}, {"v_rel_mm_s", 100}, {"T_contact_C", 100}};
  for (const auto& [name, reference] : states) {
    columns.push_back(part.at(name));
    for (std::size_t i = 0; i < sigma.size(); ++i)
      columns.back()[i] = sigma[i] * std::log(columns.back()[i] / reference);
  }
  return columns;
}

Eigen::VectorXd least_squares(const std::vector<Values>& x, const Values& y) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd normal(n, n);
  Eigen::VectorXd right(n);
  const auto dot = [](const Values& a, const Values& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      sum += a[i] * b[i];
    return sum;
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    right[i] = dot(x[static_cast<std::size_t>(i)], y);
    for (Eigen::Index j = 0; j < n; ++j)
      normal(i, j) = dot(x[static_cast<std::size_t>(i)], x[static_cast<std::size_t>(j)]);
  }
  // A state that does not vary leaves a direction open: held near 0, as a bounded fit does.
  normal.diagonal() *= 1 + 1e-9;
  return normal.ldlt().solve(right);
}

Values shear_stress(const Part& part) {
  Values k = part.at("sigma_f_MPa");
  for (double& x : k)
    x *= k_over_sigma_f;
  return k;
}

// min(mu sigma, m k): rows are given to the branch that is lower until none changes.
std::pair<double, double> orowan_fit(const Part& part, const Values& measured) {
  const Values &sigma = part.at("sigma_n_MPa"), k = shear_stress(part);
  double mu = 0.1, m = 0.3;
  for (int round = 0; round < 60; ++round) {
    double sy = 0, ss = 0, ky = 0, kk = 0;
    for (std::size_t i = 0; i < k.size(); ++i) {
      const bool slides = mu * sigma[i] < m * k[i];
      (slides ? sy : ky) += measured[i] * (slides ? sigma[i] : k[i]);
      (slides ? ss : kk) += slides ? sigma[i] * sigma[i] : k[i] * k[i];
    }
    if (ss > 0) mu = sy / ss;
    if (kk > 0) m = ky / kk;
  }
  return {mu, m};
}

Values orowan_tau(const Part& part, double mu, double m) {
  const Values& sigma = part.at("sigma_n_MPa");
  Values tau = shear_stress(part);
  for (std::size_t i = 0; i < tau.size(); ++i)
    tau[i] = std::min(mu * sigma[i], m * tau[i]);
  return tau;
}

Values linear_tau(const std::string& base, const Part& part, const Eigen::VectorXd& parameters) {
  const auto columns = regressors(base, part);
  Values tau(part.rows());
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (std::size_t i = 0; i < tau.size(); ++i)
      tau[i] += parameters[static_cast<Eigen::Index>(c)] * columns[c][i];
  for (double& x : tau)
    x = std::max(x, 0.0);
  return tau;
}

} // namespace

std::string base_law(const std::string& truth) {
  return truth == "unlike any law" ? "log_coulomb" : truth;
}

// Above the logarithmic law's line by this: a smooth limit, a maximum over the speed, and a fall
// beyond a temperature. No law of the tool has any of them.
Shape unlike_any_law(const Part& training, Random& random) {
  const double width = random.uniform(0.5, 1), hot = quantile(training.at("T_contact_C"), 0.8);
  const double fast = quantile(training.at("v_rel_mm_s"), random.uniform(0.3, 0.7));
  const double high = quantile(training.at("sigma_n_MPa"), 0.8);
  return [=](const Part& part) {
    const Values &sigma = part.at("sigma_n_MPa"), &v = part.at("v_rel_mm_s"),
                 &temperature = part.at("T_contact_C");
    Values out(part.rows());
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double load = sigma[i] / high, peak = std::log(v[i] / fast) / width;
      out[i] = std::log(std::tanh(load) / load) + 0.3 * std::exp(-peak * peak) -
               0.5 * std::log1p(std::pow(temperature[i] / hot, 4));
    }
    return out;
  };
}

// The limit is reached in a part of the rows, so that both parameters can be known.
void add_orowan(Parts& parts, double mu, Random& random) {
  Values ratio = parts.training.at("sigma_n_MPa");
  const Values k = shear_stress(parts.training);
  for (std::size_t i = 0; i < ratio.size(); ++i)
    ratio[i] *= mu / k[i];
  const double m = quantile(ratio, random.uniform(0.45, 0.75));
  for (Part* part : {&parts.training, &parts.validation})
    part->law = orowan_tau(*part, mu, m);
}

void add_friction(Parts& parts, const std::string& truth, Random& random) {
  Eigen::VectorXd logs(5);
  logs << random.uniform(0.05, 0.08), random.uniform(-0.015, 0.01), random.uniform(-0.006, 0.006),
      random.uniform(-0.007, 0.004), random.uniform(-0.008, 0.008);
  if (truth == "orowan") return add_orowan(parts, 1.5 * logs[0], random);
  if (truth != "coulomb" && truth != "log_coulomb" && truth != "unlike any law")
    throw std::invalid_argument("truth " + truth);
  for (Part* part : {&parts.training, &parts.validation}) {
    part->law = truth == "coulomb" ? linear_tau("coulomb", *part, logs.head(1))
                                   : linear_tau("log_coulomb", *part, logs);
    part->law = limited(*part, part->law);
  }
}

Values limited(const Part& part, Values tau) {
  if (!part.has("sigma_f_MPa")) return tau;
  const Values k = shear_stress(part);
  for (std::size_t i = 0; i < tau.size(); ++i)
    tau[i] = std::clamp(tau[i], 0.0, k[i]);
  return tau;
}

Values refitted(const std::string& base, const Part& training, const Values& measured,
                const Part& validation) {
  if (base == "orowan") {
    const auto [mu, m] = orowan_fit(training, measured);
    return limited(validation, orowan_tau(validation, mu, m));
  }
  const Eigen::VectorXd parameters = least_squares(regressors(base, training), measured);
  return limited(validation, linear_tau(base, validation, parameters));
}

double mean_error(const Values& measured, const Values& predicted) {
  double sum = 0;
  for (std::size_t i = 0; i < measured.size(); ++i)
    sum += std::abs(measured[i] - predicted[i]);
  return sum / static_cast<double>(measured.size());
}

} // namespace frictab::foreign
