// Correlations of parameters, and their effect on the extrapolation of a law beyond the tests.
#include "calibrate/determined.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include "calibrate/fit.h"
#include "calibrate/sandwich.h"
#include "calibrate/stress_error.h"
#include "core/text.h"
#include "data/meaning.h"
#include "data/middle.h"

namespace frictab::calibrate {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double tied_correlation = 0.95; // |correlation| of two parameters
constexpr double cause_correlation =
    0.9; // |correlation| of a parameter with the change of the stress
// Change of ln tau over a doubling. Literature exponents listed here change it by at most 0.28
// (wang_soap, T^-0.403; less for filzek_ludwig and wzl), so an interval that is wider on both sides
// cannot distinguish between them.
constexpr double sensible_change = 0.3;
constexpr double temperature_step_K = 50;    // for a temperature, instead of doubling
constexpr double wide_share_of_bounds = 0.5; // share of the bounds that an interval may cover
constexpr double level_share = 0.5; // relative change of a level's derivative over the data

// A state that the tests could be run at, and its range in the data.
struct Reach {
  std::size_t input;
  std::string name;
  bool kelvins;  // steps are differences, not ratios
  double lowest; // least physically meaningful value
  double low, middle, high;

  double stepped(bool above) const {
    if (kelvins)
      return above ? middle + temperature_step_K : std::max(middle - temperature_step_K, lowest);
    return above ? 2 * middle : std::max(0.5 * middle, lowest);
  }
  // Value for a test on one side of the data, far enough from their middle to be informative.
  double proposed(bool above) const {
    if (kelvins) return above ? std::max(high, middle + 30) : std::min(low, middle - 30);
    return above ? std::max(high, 1.5 * middle) : std::max(std::min(low, middle / 1.5), lowest);
  }
};

// Rounds to two significant digits, as a rig is set: "670".
std::string rounded(double value) {
  if (value == 0) return "0";
  const double step = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 1);
  return fmt::format("{:g}", step * std::round(value / step));
}

class Determined {
public:
  Determined(ModelFit& fit, const InputColumns& columns, std::size_t experiments)
      : fit_(fit), law_(*fit.model.law), u_(*fit.uncertainty), error_(fit.model, columns.names()),
        experiments_(experiments),
        t_(experiments < 2 ? 0 : gsl_cdf_tdist_Pinv(0.975, static_cast<double>(experiments - 1))),
        middle_(middle_of(columns)) {
    for (std::size_t i = 0; i < columns.names().size(); ++i) {
      const std::string& name = columns.names()[i];
      const auto [low, high] = columns.range(i);
      const data::Meaning meaning = data::meaning_of(name);
      const bool kelvins = meaning.unit == "degC";
      if (law_.levels.count(name) || !std::isfinite(low) || !(kelvins || middle_[i] > 0)) continue;
      reaches_.push_back({i, name, kelvins, meaning.lowest, low, middle_[i], high});
    }
  }

  void run() {
    fit_.determination.condition = u_.condition;
    add_pairs();
    add_open();
    add_wide();
    add_tied();
    for (const Determination::Open& open : fit_.determination.not_determined)
      fit_.remarks.push_back(open.text);
    add_remarked(); // already remarks of the fit
  }

private:
  std::size_t size() const { return law_.parameters.size(); }
  const std::string& name(std::size_t p) const { return law_.parameters[p].name; }
  double correlation(std::size_t a, std::size_t b) const { return u_.correlation(a, b); }

  void add_pairs() {
    for (std::size_t a = 0; a < size(); ++a)
      for (std::size_t b = a + 1; b < size(); ++b)
        if (correlation(a, b) != 0)
          fit_.determination.pairs.push_back({name(a), name(b), correlation(a, b)});
    auto& pairs = fit_.determination.pairs;
    std::ranges::stable_sort(pairs, std::greater{},
                             [](const auto& pair) { return std::abs(pair.correlation); });
    pairs.resize(std::min<std::size_t>(pairs.size(), 2));
  }

  std::optional<VectorXd> slope_at(const Reach& reach, double value) const {
    std::vector<double> state = middle_;
    state[reach.input] = value;
    return error_.slope(state);
  }

  std::string value_text(std::size_t p) const {
    return fmt::format("{} = {:.3g} +- {:.2g}", name(p), fit_.model.parameters[p],
                       fit_.std_error[p]);
  }

  void add(std::vector<std::size_t> which, const std::string& why) {
    Determination::Open open;
    std::vector<std::string> values;
    for (const std::size_t p : which) {
      open.parameters.push_back(name(p));
      values.push_back(value_text(p));
      open_.insert(p);
    }
    open.text = fmt::format("{}: these tests do not determine {}{}", join(values, ", "),
                            which.size() > 1 ? "them" : "it", why);
    fit_.determination.not_determined.push_back(std::move(open));
  }

  // Adds parameters that make the change of the stress over a doubling of a state uncertain.
  void add_open() {
    const auto in_middle = error_.known() ? error_.slope(middle_) : std::nullopt;
    if (!in_middle || experiments_ < 2) return;
    for (const Reach& reach : reaches_) {
      double worst = sensible_change;
      VectorXd contrast;
      for (const bool above : {false, true}) {
        const auto there = slope_at(reach, reach.stepped(above));
        if (!there || !(t_ * error_.of(*there - *in_middle) > worst)) continue;
        contrast = *there - *in_middle;
        worst = t_ * error_.of(contrast);
      }
      if (contrast.size() == 0) continue;
      const VectorXd with = error_.with(contrast);
      std::vector<std::size_t> which;
      for (std::size_t p = 0; p < size(); ++p)
        if (fit_.std_error[p] > 0 && !open_.count(p) &&
            std::abs(with(p)) > cause_correlation * fit_.std_error[p] * error_.of(contrast))
          which.push_back(p);
      if (!which.empty())
        add(which, fmt::format("; tests at {} {} and {} would", reach.name,
                               rounded(reach.proposed(false)), rounded(reach.proposed(true))));
    }
  }

  // Adds parameters whose interval covers most of their bounds.
  void add_wide() {
    if (experiments_ < 2) return;
    for (std::size_t p = 0; p < size(); ++p) {
      const models::Parameter& parameter = law_.parameters[p];
      const double half = t_ * fit_.std_error[p];
      const double share = is_scale(parameter) ? 2 * half / fit_.model.parameters[p] /
                                                     std::log(parameter.upper / parameter.lower)
                                               : 2 * half / (parameter.upper - parameter.lower);
      if (share > wide_share_of_bounds && !open_.count(p))
        add({p}, fmt::format(
                     " between {:g} and {:g}{}", parameter.lower, parameter.upper,
                     parameter.settled_by.empty() ? "" : "; " + parameter.settled_by + " would"));
    }
  }

  // Whether the stress is nearly proportional to the parameter over the data.
  bool is_level(std::size_t p) const {
    const Index at = p;
    const auto here = error_.slope(middle_);
    if (!here || (*here)(at) == 0) return false;
    for (const Reach& reach : reaches_)
      for (const double value : {reach.low, reach.high}) {
        const auto there = slope_at(reach, value);
        if (there && std::abs((*there)(at) / (*here)(at)-1) > level_share) return false;
      }
    return true;
  }

  void add_tied() {
    for (std::size_t a = 0; a < size(); ++a)
      for (std::size_t b = a + 1; b < size(); ++b) {
        if (std::abs(correlation(a, b)) <= tied_correlation || open_.count(a) || open_.count(b))
          continue;
        if (!u_.why_none[a].empty() || !u_.why_none[b].empty()) continue;
        if (is_level(a) || is_level(b)) continue;
        std::vector<std::string> values{value_text(a), value_text(b)};
        fit_.determination.not_determined.push_back(
            {{name(a), name(b)},
             fmt::format(
                 "{}: these tests hardly distinguish one from the other (correlation {:.3f}): "
                 "tests that vary what one depends on, and not what the other does, would",
                 join(values, ", "), correlation(a, b))});
      }
  }

  // Adds parameters that the fit itself reported.
  void add_remarked() {
    for (std::size_t p = 0; p < size(); ++p)
      if (!u_.why_none[p].empty())
        fit_.determination.not_determined.push_back({{name(p)}, name(p) + ": " + u_.why_none[p]});
  }

  ModelFit& fit_;
  const models::Law& law_;
  const Uncertainty& u_;
  StressError error_;
  std::size_t experiments_;
  double t_; // half width of a 95 % interval in standard errors
  std::vector<double> middle_;
  std::vector<Reach> reaches_;
  std::set<std::size_t> open_;
};

} // namespace

std::vector<double> middle_of(const InputColumns& columns) {
  constexpr std::size_t enough = 100'000; // evenly spaced rows
  std::vector<double> middle;
  for (std::size_t i = 0; i < columns.names().size(); ++i) {
    const std::span<const double> all = columns[i];
    const std::size_t step = std::max<std::size_t>(1, all.size() / enough);
    std::vector<double> values;
    for (std::size_t row = 0; row < all.size(); row += step)
      if (!std::isnan(all[row])) values.push_back(all[row]);
    middle.push_back(values.empty() ? 0 : data::upper_median(std::move(values)));
  }
  return middle;
}

void add_determination(ModelFit& fit, const InputColumns& columns, std::size_t experiments) {
  if (fit.uncertainty) Determined(fit, columns, experiments).run();
}

} // namespace frictab::calibrate
