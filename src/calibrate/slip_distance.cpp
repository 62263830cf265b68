// Scan and Brent's method over ln D_c.
#include "calibrate/slip_distance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>

#include "calibrate/calibration.h"
#include "calibrate/law_problem.h"
#include "core/parallel.h"
#include "core/text.h"
#include "data/derived.h"

namespace frictab::calibrate {

using data::Dataset;
using models::Law;

namespace {

// Makes GSL return errors as values instead of ending the program. Its handler is shared by the
// whole process, so a thread that changed it temporarily would affect the others.
[[maybe_unused]] gsl_error_handler_t* const of_the_library = gsl_set_error_handler_off();

constexpr std::size_t tries = 25; // of a scan: five decades in steps of 1.6
constexpr int refinements = 12;
constexpr double settled = 1e-3; // of ln D: resolution of the four digits in the name

struct Search {
  const Law& law;
  std::size_t parameter;
  const models::Conventions& conventions;
  const Dataset& data;
  const CalibrationOptions& options;

  double loss(double ln_distance) const {
    const Law tried = at_slip_distance(law, parameter, std::exp(ln_distance));
    return LawProblem(tried, conventions, data)
        .fit(options.loss, options.huber_delta_MPa)
        .result.cost;
  }
};

double loss_of(double ln_distance, void* search) {
  return static_cast<const Search*>(search)->loss(ln_distance);
}

// Finds the least loss between the two tries on either side of the best one.
double refined(Search& search, double low, double best, double high, std::size_t& evaluations) {
  gsl_function function{loss_of, &search};
  const std::unique_ptr<gsl_min_fminimizer, void (*)(gsl_min_fminimizer*)> brent(
      gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent), gsl_min_fminimizer_free);
  const bool begins =
      gsl_min_fminimizer_set(brent.get(), &function, best, low, high) == GSL_SUCCESS;
  for (int i = 0; begins && i < refinements; ++i) {
    if (gsl_min_fminimizer_iterate(brent.get()) != GSL_SUCCESS) break;
    ++evaluations;
    if (gsl_min_fminimizer_x_upper(brent.get()) - gsl_min_fminimizer_x_lower(brent.get()) < settled)
      break;
  }
  return begins ? gsl_min_fminimizer_x_minimum(brent.get()) : best;
}

using Symbols = std::map<std::string, expr::Expr>;

// Replaces symbols in the law's formula.
Law with_symbols(Law law, const Symbols& by) {
  law.build = [build = law.build, by](const models::Conventions& conventions) {
    const models::Formula formula = build(conventions);
    return models::Formula{substitute(formula.value, by), substitute(formula.combine, by)};
  };
  return law;
}

} // namespace

std::optional<std::size_t> slip_distance(const Law& law, const models::Conventions& conventions) {
  for (const std::string& input : models::inputs(law, conventions)) {
    const auto state = data::slip_state(input);
    for (std::size_t p = 0; state && p < law.parameters.size(); ++p)
      if (law.parameters[p].name == state->parameter) return p;
  }
  return std::nullopt;
}

Law at_slip_distance(const Law& law, std::size_t parameter, double distance_mm) {
  const std::string name = law.parameters[parameter].name;
  Symbols numbers;
  for (const auto& [family, rule] : data::slip_states()) {
    const std::string state = data::slip_state_name(rule, distance_mm);
    numbers.emplace(family + name, expr::Expr::symbol(state));
    numbers[name] = data::slip_state(state)->distance_mm;
  }
  Law at = with_symbols(law, numbers);
  at.parameters.erase(at.parameters.begin() + parameter);
  at.formula += fmt::format("; {} = {} mm", name, shortest(numbers.at(name).value()));
  return at;
}

SlipDistance find_slip_distance(const Law& law, std::size_t parameter,
                                const models::Conventions& conventions, const Dataset& data,
                                const CalibrationOptions& options) {
  const models::Parameter& distance = law.parameters[parameter];
  Search search{law, parameter, conventions, data, options};
  const double low = std::log(distance.lower),
               step = (std::log(distance.upper) - low) / (tries - 1);
  std::vector<double> losses(tries);
  parallel_for(
      tries, [&](std::size_t i) { losses[i] = search.loss(low + step * static_cast<double>(i)); });
  const auto best = static_cast<std::size_t>(std::ranges::min_element(losses) - losses.begin());
  SlipDistance found{std::exp(low + step * static_cast<double>(best)), false, tries};
  found.at_bound = best == 0 || best + 1 == tries;
  if (!found.at_bound) {
    const double at = low + step * static_cast<double>(best);
    found.distance_mm = std::exp(refined(search, at - step, at, at + step, found.evaluations));
  }
  return found;
}

namespace {

std::string value_name(const std::string& family) {
  return "value_of_" + family;
}
std::string slope_name(const std::string& family) {
  return "slope_of_" + family;
}

// Adds the distance to the law as a parameter of its formula: state = value + (D - D0) slope.
Law along_distance(const Law& law, const std::string& name, double distance_mm) {
  Symbols straight;
  for (const auto& [family, rule] : data::slip_states())
    straight.emplace(family + name, expr::Expr::symbol(value_name(family)) +
                                        (expr::Expr::symbol(name) - distance_mm) *
                                            expr::Expr::symbol(slope_name(family)));
  return with_symbols(law, straight);
}

// Adds value and slope of every state of the law to the data.
void add_states(Dataset& data, const std::vector<std::string>& inputs, const std::string& name,
                double distance_mm) {
  constexpr double step = 0.02;
  for (const auto& slip_state : data::slip_states()) {
    const std::string& family = slip_state.first;
    if (std::ranges::find(inputs, family + name) == inputs.end()) continue;
    const auto at = [&data, rule = slip_state.second](double distance) {
      const std::string state = data::slip_state_name(rule, distance); // rounds the distance
      return std::pair{data::slip_state(state)->distance_mm,
                       data::derive(*data::find_derived(state), data, {})};
    };
    const auto [low, below] = at(distance_mm * (1 - step));
    const auto [high, above] = at(distance_mm * (1 + step));
    std::vector<double> slope(data.rows());
    for (std::size_t i = 0; i < slope.size(); ++i)
      slope[i] = (above[i] - below[i]) / (high - low);
    std::vector<double> value = at(distance_mm).second;
    data.columns.push_back({value_name(family), "", std::move(value), {}});
    data.columns.push_back({slope_name(family), "", std::move(slope), {}});
  }
}

} // namespace

Uncertainty slip_distance_uncertainty(const Law& law, std::size_t parameter, double distance_mm,
                                      const models::Model& fitted, const Dataset& data,
                                      const CalibrationOptions& options) {
  const std::string& name = law.parameters[parameter].name;
  const double rounded =
      data::slip_state(data::slip_state_name(data::Continuation::aging, distance_mm))->distance_mm;
  Dataset with_states = data;
  add_states(with_states, models::inputs(law, fitted.conventions), name, rounded);
  const std::vector<double> tau = predict(fitted, data);
  LawFit fit;
  fit.result.parameters = fitted.parameters;
  fit.result.parameters.insert(fit.result.parameters.begin() + parameter, rounded);
  for (std::size_t i = 0; i < tau.size(); ++i)
    fit.result.cost +=
        std::abs(data.values("tau_R_MPa")[i] - tau[i]) / static_cast<double>(tau.size());
  const Law along = along_distance(law, name, rounded);
  LawProblem(along, fitted.conventions, with_states, tau)
      .add_uncertainty(fit, options.loss, options.huber_delta_MPa, data);
  return std::move(fit.uncertainty);
}

} // namespace frictab::calibrate
