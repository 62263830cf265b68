// Leaves out tests, one at a time.
#include "calibrate/influence.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "calibrate/choice.h"
#include "calibrate/cross_validation.h"
#include "calibrate/experiment_errors.h"
#include "calibrate/fit_law.h"
#include "calibrate/sandwich.h"
#include "core/parallel.h"
#include "core/text.h"

namespace frictab::calibrate {

using Eigen::Index;

namespace {

// Tests per law without which it is refitted if one step indicates their influence.
constexpr std::size_t most_refits = 3;
// Tolerance for the first step, which is slightly off if a law is not linear.
constexpr double first_step_slack = 0.8;

// Shift in standard errors above which a test is reported first.
constexpr double far_shift = 2;

double size_of(const Influence::Moved& m) {
  return std::abs(m.without - m.value) / m.std_error;
}

double size_of(const Influence& one) {
  return one.moved.empty() ? 0 : size_of(one.moved.front());
}

// Shifts of the parameters by a law fitted without a test.
Influence moved_by(const ModelFit& fit, const std::string& experiment,
                   const models::Model& without) {
  Influence found{fit.model.law->name, experiment, {}, ""};
  const std::size_t size = fit.model.parameters.size();
  if (without.parameters.size() != size || without.covariance.size() != size * size) return found;
  for (std::size_t p = 0; p < size; ++p) {
    const Influence::Moved moved{fit.model.law->parameters[p].name, fit.model.parameters[p],
                                 without.parameters[p],
                                 std::sqrt(without.covariance[p * size + p])};
    if (moved.std_error > 0 && size_of(moved) > 1) found.moved.push_back(moved);
  }
  std::ranges::stable_sort(found.moved,
                           [](const auto& a, const auto& b) { return size_of(a) > size_of(b); });
  return found;
}

// Tests that may move the law according to one step each, largest shift first.
std::vector<std::size_t> suspects(const Uncertainty& u) {
  std::vector<std::pair<double, std::size_t>> found;
  for (Index e = 0; e < u.moved_without.cols(); ++e) {
    double most = 0;
    for (Index p = 0; p < u.moved_without.rows(); ++p)
      if (const double error = u.error_without(p, e); error > 0)
        most = std::max(most, std::abs(u.moved_without(p, e)) / error);
    if (most > first_step_slack) found.emplace_back(-most, static_cast<std::size_t>(e));
  }
  std::ranges::sort(found);
  std::vector<std::size_t> tests;
  for (const auto& [size, e] : found)
    if (tests.size() < most_refits) tests.push_back(e);
  return tests;
}

// Influential tests of one law, largest shift first.
std::vector<Influence> of_law(const ModelFit& fit, const models::Conventions& conventions,
                              const CalibrationInput& input) {
  const std::vector<std::string>& tests = input.training.experiments;
  std::vector<Influence> found;
  const auto add = [&](std::size_t e, const models::Model& without) {
    Influence one = moved_by(fit, tests[e], without);
    if (!one.moved.empty()) found.push_back(std::move(one));
  };
  if (!fit.uncertainty || tests.size() < 3) return found;
  if (fit.without.size() == tests.size())
    for (std::size_t e = 0; e < tests.size(); ++e)
      add(e, fit.without[e]);
  else
    for (const std::size_t e : suspects(*fit.uncertainty))
      add(e, fit_law(*fit.model.law, conventions, without_kin(input.training, e), input.options)
                 .model);
  std::ranges::stable_sort(
      found, [](const Influence& a, const Influence& b) { return size_of(a) > size_of(b); });
  return found;
}

void add_first_places(Calibration& calibration, const CalibrationInput& input) {
  const std::vector<std::string>& judges = input.validation.experiments;
  if (judges.size() < 3) return;
  std::vector<LawErrors> laws;
  for (const ModelFit& fit : calibration.fits)
    if (!fit.reference) laws.push_back({fit.model.law->name, unseen_sums(fit, input.validation)});
  if (laws.size() < 2) return;
  std::vector<double> times(judges.size(), 1.0);
  if (best_of(laws, times) != 0) return; // it was ranked on rows that are not in memory
  const std::string& leader = laws.front().law;
  for (std::size_t e = 0; e < judges.size(); ++e) {
    times[e] = 0;
    const std::size_t first = best_of(laws, times);
    times[e] = 1;
    if (first == 0) continue;
    const auto known = std::ranges::find_if(calibration.influence, [&](const Influence& one) {
      return one.law == leader && one.experiment == judges[e];
    });
    Influence& one = known != calibration.influence.end()
                         ? *known
                         : *calibration.influence.insert(calibration.influence.begin(),
                                                         {leader, judges[e], {}, ""});
    one.first = laws[first].law;
  }
}

} // namespace

void add_influence(Calibration& calibration, const models::Conventions& conventions,
                   const CalibrationInput& input) {
  std::vector<std::vector<Influence>> of_laws(calibration.fits.size());
  parallel_for(of_laws.size(), [&](std::size_t i) {
    of_laws[i] = of_law(calibration.fits[i], conventions, input);
  });
  calibration.influence.clear();
  for (std::vector<Influence>& found : of_laws)
    calibration.influence.insert(calibration.influence.end(), found.begin(), found.end());
  add_first_places(calibration, input);
}

std::string influence_sentence(const Calibration& calibration) {
  const auto& all = calibration.influence;
  if (all.empty()) return "";
  // A large shift of a better law comes first, then a change of the first place, then any shift.
  const auto far =
      std::ranges::find_if(all, [](const Influence& one) { return size_of(one) > far_shift; });
  const auto first =
      std::ranges::find_if(all, [](const Influence& one) { return !one.first.empty(); });
  const Influence& most = far != all.end() ? *far : first != all.end() ? *first : all.front();
  std::string text = fmt::format("test '{}'", most.experiment);
  if (!most.moved.empty()) {
    std::vector<std::string> values;
    for (const Influence::Moved& m : most.moved)
      values.push_back(fmt::format("{} = {:.3g}, not {:.3g}", m.parameter, m.without, m.value));
    text += fmt::format(" moves {} by up to {:.1f} standard errors: without it {}", most.law,
                        size_of(most), join(values, "; "));
  }
  if (!most.first.empty())
    text += fmt::format("{} without it {} would be first, not {}", most.moved.empty() ? ":" : ";",
                        most.first, most.law);
  std::set<std::string> others;
  for (const Influence& one : all)
    if (one.experiment != most.experiment) others.insert(one.experiment);
  if (others.empty()) return text;
  return fmt::format("{} (calibration.json names {} more)", text, others.size());
}

} // namespace frictab::calibrate
