// Computes errors of the truth, of constants of the literature and of calibrated constants.
#include "twin/twin_summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "twin/twin_draft.h"

namespace frictab::twin {

namespace {

using Values = std::vector<double>;

// sigma_N, k and the measurement of one part; empty where the column is hidden.
struct Part {
  Values sigma, k, tau;
};

Part columns_of(const TwinPart& part) {
  Part out{{}, {}, part.data.find("tau_R_MPa")->values};
  if (const data::Column* sigma = part.data.find("sigma_n_MPa")) out.sigma = sigma->values;
  if (const data::Column* sigma_f = part.data.find("sigma_f_MPa"))
    for (const double value : sigma_f->values)
      out.k.push_back(value / std::sqrt(3.0));
  return out;
}

TwinError error_of(const Values& tau, const std::function<double(std::size_t)>& law) {
  TwinError error;
  if (tau.empty()) return error;
  for (std::size_t i = 0; i < tau.size(); ++i) {
    const double residual = tau[i] - law(i);
    error.mae_MPa += std::abs(residual);
    error.rmse_MPa += residual * residual;
  }
  const double n = static_cast<double>(tau.size());
  return {error.mae_MPa / n, std::sqrt(error.rmse_MPa / n)};
}

// Fits c of tau = c x by least squares over the rows for which `use` is true; `otherwise` if it
// never is.
double slope(const Values& x, const Values& tau, const std::function<bool(std::size_t)>& use,
             double otherwise) {
  double xy = 0;
  double xx = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!use(i)) continue;
    xy += x[i] * tau[i];
    xx += x[i] * x[i];
  }
  return xx > 0 ? xy / xx : otherwise;
}

double slope(const Values& x, const Values& tau) {
  return slope(
      x, tau, [](std::size_t) { return true; }, 0);
}

// Fits min(mu sigma, m k) by alternating between the rows of each branch and the branch's own
// slope; returns the best of several starts, since the sum of squares has more than one minimum.
std::array<double, 2> fit_orowan(const Part& part, double mu0, double m0) {
  std::array<double, 2> best{mu0, m0};
  double least = INFINITY;
  for (const double tilt : {0.9, 0.97, 1.0, 1.03, 1.1, 1.3}) {
    double mu = mu0 * tilt;
    double m = m0 * (2 - tilt);
    for (int i = 0; i < 30; ++i) {
      const auto coulomb = [&](std::size_t r) { return mu * part.sigma[r] <= m * part.k[r]; };
      const double new_mu = slope(part.sigma, part.tau, coulomb, mu);
      m = slope(
          part.k, part.tau, [&](std::size_t r) { return !coulomb(r); }, m);
      mu = new_mu;
    }
    const double rmse = error_of(part.tau, [&](std::size_t r) {
                          return std::min(mu * part.sigma[r], m * part.k[r]);
                        }).rmse_MPa;
    if (rmse < least) {
      least = rmse;
      best = {mu, m};
    }
  }
  return best;
}

std::vector<std::pair<std::string, double>> named(const models::Law& law,
                                                  const Values& parameters) {
  std::vector<std::pair<std::string, double>> constants;
  for (std::size_t p = 0; p < parameters.size(); ++p)
    constants.emplace_back(law.parameters[p].name, parameters[p]);
  return constants;
}

class Builder {
public:
  explicit Builder(const Twin& twin)
      : twin_(twin), training_(columns_of(twin.training)),
        validation_(columns_of(twin.validation)) {}

  void truth() {
    add("oracle", {}, twin_.training.oracle_MPa, twin_.validation.oracle_MPa, 1);
    if (twin_.effects.empty()) return;
    if (twin_.law) {
      add("base_law", named(twin_.law->law(), twin_.recalibrated), twin_.training.recalibrated_MPa,
          twin_.validation.recalibrated_MPa, 1);
      return;
    }
    const auto factor = slope(twin_.training.base_MPa, training_.tau);
    add("base_law", {{"factor", factor}}, twin_.training.base_MPa, twin_.validation.base_MPa,
        factor);
  }

  void constants() {
    for (const auto& [name, mu] : {std::pair{"coulomb_0.04", 0.04}, {"coulomb_0.08", 0.08}})
      if (has_sigma()) add(name, {{"mu", mu}}, training_.sigma, validation_.sigma, mu);
    if (has_k()) add("shear_0.12", {{"m", 0.12}}, training_.k, validation_.k, 0.12);
  }

  void calibrated() {
    const double mu = slope(training_.sigma, training_.tau);
    const double m = slope(training_.k, training_.tau);
    if (has_sigma()) add("coulomb", {{"mu", mu}}, training_.sigma, validation_.sigma, mu);
    if (has_k()) add("shear", {{"m", m}}, training_.k, validation_.k, m);
    if (!has_sigma() || !has_k()) return;
    const auto both = fit_orowan(training_, mu, m);
    add("orowan", {{"mu", both[0]}, {"m", both[1]}}, lower(training_, both),
        lower(validation_, both), 1);
  }

  TwinSummary summary;

private:
  bool has_sigma() const { return !training_.sigma.empty(); }
  bool has_k() const { return !training_.k.empty(); }

  static Values lower(const Part& part, const std::array<double, 2>& both) {
    Values tau(part.tau.size());
    for (std::size_t i = 0; i < tau.size(); ++i)
      tau[i] = std::min(both[0] * part.sigma[i], both[1] * part.k[i]);
    return tau;
  }

  void add(const std::string& name, std::vector<std::pair<std::string, double>> constants,
           const Values& training, const Values& validation, double factor) {
    summary.laws.push_back(
        {name, std::move(constants),
         error_of(training_.tau, [&](std::size_t i) { return factor * training[i]; }),
         error_of(validation_.tau, [&](std::size_t i) { return factor * validation[i]; })});
  }

  const Twin& twin_;
  Part training_;
  Part validation_;
};

} // namespace

const TwinLaw* TwinSummary::find(std::string_view name) const {
  const auto at = std::ranges::find_if(laws, [&](const TwinLaw& law) { return law.name == name; });
  return at == laws.end() ? nullptr : &*at;
}

TwinSummary summarise(const Twin& twin) {
  Builder builder(twin);
  builder.truth();
  builder.constants();
  builder.calibrated();
  return std::move(builder.summary);
}

} // namespace frictab::twin
