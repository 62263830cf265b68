// Scan and Brent's method over ln D_c.
#include "calibrate/slip_distance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>

#include "calibrate/law_problem.h"
#include "core/parallel.h"
#include "core/text.h"
#include "data/derived.h"

namespace frictab::calibrate {

using data::Dataset;
using models::Law;

namespace {

constexpr std::size_t tries = 25; // of a scan: five decades in steps of 1.6
constexpr int refinements = 12;
constexpr double settled = 1e-3; // of ln D: what four digits of the name can tell

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

// The least loss between two tries on either side of the best one.
double refined(Search& search, double low, double best, double high, std::size_t& evaluations) {
  gsl_function function{loss_of, &search};
  const std::unique_ptr<gsl_min_fminimizer, void (*)(gsl_min_fminimizer*)> brent(
      gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent), gsl_min_fminimizer_free);
  gsl_error_handler_t* const before = gsl_set_error_handler_off();
  const bool begins =
      gsl_min_fminimizer_set(brent.get(), &function, best, low, high) == GSL_SUCCESS;
  for (int i = 0; begins && i < refinements; ++i) {
    if (gsl_min_fminimizer_iterate(brent.get()) != GSL_SUCCESS) break;
    ++evaluations;
    if (gsl_min_fminimizer_x_upper(brent.get()) - gsl_min_fminimizer_x_lower(brent.get()) < settled)
      break;
  }
  gsl_set_error_handler(before);
  return begins ? gsl_min_fminimizer_x_minimum(brent.get()) : best;
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
  std::map<std::string, expr::Expr> numbers;
  for (const auto& [family, rule] : data::slip_states()) {
    const std::string state = data::slip_state_name(rule, distance_mm);
    numbers.emplace(family + name, expr::Expr::symbol(state));
    numbers[name] = data::slip_state(state)->distance_mm;
  }
  Law at = law;
  at.parameters.erase(at.parameters.begin() + static_cast<std::ptrdiff_t>(parameter));
  at.formula += fmt::format("; {} = {} mm", name, shortest(numbers.at(name).value()));
  at.build = [build = law.build, numbers](const models::Conventions& conventions) {
    const models::Formula formula = build(conventions);
    return models::Formula{substitute(formula.value, numbers),
                           substitute(formula.combine, numbers)};
  };
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
  const auto best =
      static_cast<std::size_t>(std::min_element(losses.begin(), losses.end()) - losses.begin());
  SlipDistance found{std::exp(low + step * static_cast<double>(best)), false, tries};
  found.at_bound = best == 0 || best + 1 == tries;
  if (!found.at_bound) {
    const double at = low + step * static_cast<double>(best);
    found.distance_mm = std::exp(refined(search, at - step, at, at + step, found.evaluations));
  }
  return found;
}

} // namespace frictab::calibrate
