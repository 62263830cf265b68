// Prints the laws by error, their comparison, and the laws left out.
#include "run/ranking_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "calibrate/choice.h"
#include "calibrate/comparison.h"
#include "calibrate/influence.h"
#include "calibrate/noise_floor.h"
#include "calibrate/recommended.h"
#include "calibrate/refit.h"
#include "core/column_width.h"
#include "core/text.h"
#include "report/judged.h"
#include "report/numbers.h"

namespace frictab::run {

namespace {

std::string parameters(const calibrate::ModelFit& fit) {
  if (std::string size = calibrate::size_of_trained(fit); !size.empty()) return size;
  std::string text;
  for (std::size_t i = 0; i < fit.model.parameters.size(); ++i)
    text += fmt::format("{}{} {:.4g}", i ? ", " : "", fit.model.law->parameters[i].name,
                        fit.model.parameters[i]);
  return text + (fit.reference ? std::string(" (") + calibrate::reference_words + ")" : "");
}

// Adds one line per reason: "left out, no sigma_f_MPa: levanov, shaw".
void add_left_out(std::string& out, const calibrate::Calibration& calibration) {
  std::map<std::string, std::string> laws;
  for (const calibrate::LeftOut& left : calibration.left_out) {
    std::string& list = laws[left.needs];
    list += (list.empty() ? "" : ", ") + left.law;
  }
  for (const auto& [reason, list] : laws)
    out += fmt::format("  skipped, needs {}: {}\n", reason, list);
}
std::string range_of(const calibrate::Interval& interval, int decimals) {
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) return "-";
  return fmt::format("{:.{}f} .. {:.{}f}", interval.low, decimals, interval.high, decimals);
}
std::size_t name_width(const calibrate::Calibration& calibration) {
  std::vector<std::string> names;
  for (const calibrate::ModelFit& fit : calibration.fits)
    names.push_back(fit.model.law->name);
  return column_width(names);
}
// Extra column width for small stresses, which need more decimals.
int more_width(int decimals) {
  return std::max(0, decimals - 4);
}
void add_floor(std::string& out, const calibrate::Calibration& calibration, int decimals) {
  if (!calibration.noise_floors.empty()) {
    const calibrate::NoiseFloor& f = calibration.noise_floors.front();
    const int more = more_width(decimals);
    out += fmt::format("  {:<{}}{:>{}}  {:<{}}{:>{}.{}f}{:>{}}   {}{}\n", "noise floor",
                       name_width(calibration),
                       calibrate::noise_floor_sign(f) + fmt::format("{:.{}f}", f.mae_MPa, decimals),
                       8 + more, range_of(f.mae_interval, decimals), 19 + 2 * more, f.rmse_MPa,
                       8 + more, decimals, "", 20 + 2 * more, calibrate::noise_floor_name(f),
                       f.part == "training" ? ", training data" : "");
  }
  const std::string advice = calibrate::noise_floor_advice(calibration);
  if (!advice.empty()) out += fmt::format("  the noise floor is not known: {}\n", advice);
}

void add_choice(std::string& out, const calibrate::Choice& choice, int decimals) {
  if (choice.draws == 0) return;
  out += fmt::format("  {}\n  {}\n", calibrate::expectation_sentence(choice, decimals),
                     calibrate::share_sentence(choice));
}

void add_comparison(std::string& out, const calibrate::Comparisons& comparisons) {
  if (comparisons.laws.size() < 2) return;
  out += fmt::format("  {}\n  {}\n", calibrate::pairwise_sentence(comparisons),
                     calibrate::family_sentence(comparisons));
}

// Adds the three best laws; benchmark.md has all.
void add_conditional(std::string& out, const calibrate::Conditional& c, int decimals) {
  if (c.laws.empty()) return;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, c.laws.size()); ++i)
    names.push_back(c.laws[i].law);
  const std::size_t width = column_width(names);
  const int more = more_width(decimals);
  out +=
      fmt::format("\nConditional use, NOT ranked above: a gain per experiment from its own first "
                  "{:g} mm\n(MAE of the rest, MPa):\n  {:<{}}{:>{}}{:>{}}   {}\n",
                  c.condition_on_mm, "law", width, "MAE", 8 + more, "without gain", 14 + more,
                  "gained, 95 % interval");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const calibrate::ConditionalFit& fit = c.laws[i];
    out += fmt::format("  {:<{}}{:>{}.{}f}{:>{}.{}f}   {:.{}f}, {}\n", fit.law, width,
                       fit.conditional.mae_MPa, 8 + more, decimals, fit.unconditional.mae_MPa,
                       14 + more, decimals, fit.gain.value_MPa, decimals,
                       range_of(fit.gain.interval, decimals));
  }
  if (c.n_without_start > 0)
    out += fmt::format("  {} of {} experiments have no row in the first {:g} mm: without a gain\n",
                       c.n_without_start, c.n_experiments, c.condition_on_mm);
}

void add_ranking(std::string& out, const calibrate::Calibration& calibration) {
  const int decimals = report::error_decimals(calibration);
  out += fmt::format("{} (tau_R, MPa):\n", report::judged_words(calibration.judged_by).ranking);
  const std::size_t width = name_width(calibration);
  const int more = more_width(decimals);
  out += fmt::format("  {:<{}}{:>{}}  {:<{}}{:>{}}{:>{}}{:>{}}   {}\n", "law", width, "MAE",
                     8 + more, "95 % interval", 19 + 2 * more, "RMSE", 8 + more, "bias", 9 + more,
                     "train MAE", 11 + more, "parameters");
  for (const calibrate::ModelFit& fit : calibration.fits) {
    const calibrate::Metrics& v = fit.validation;
    const std::string interval = range_of(v.mae_interval, decimals);
    out += fmt::format("  {:<{}}{:>{}.{}f}  {:<{}}{:>{}.{}f}{:>{}.{}f}{:>{}.{}f}   {}\n",
                       fit.model.law->name, width, v.mae_MPa, 8 + more, decimals, interval,
                       19 + 2 * more, v.rmse_MPa, 8 + more, decimals, v.bias_MPa, 9 + more,
                       decimals, fit.training.mae_MPa, 11 + more, decimals, parameters(fit));
  }
  add_floor(out, calibration, decimals);
  add_comparison(out, calibration.comparisons);
  add_choice(out, calibration.choice, decimals);
  if (const std::string which = calibrate::recommended_sentence(calibration, decimals);
      !which.empty())
    out += fmt::format("  {}\n", which);
  const std::string delivery = calibrate::delivery_sentence(calibration, decimals);
  if (!delivery.empty()) out += fmt::format("  {}\n", delivery);
  if (const std::string one = calibrate::influence_sentence(calibration); !one.empty())
    out += fmt::format("  influence: {}\n", one);
  for (const calibrate::ModelFit& fit : calibration.fits)
    for (const std::string& remark : fit.remarks)
      out += fmt::format("  {}: {}\n", fit.model.law->name, remark);
  add_left_out(out, calibration);
}
} // namespace

std::string ranking_text(const calibrate::Calibration& calibration) {
  std::string out;
  add_ranking(out, calibration);
  add_conditional(out, calibration.conditional, report::error_decimals(calibration));
  return out;
}

std::string best_law_in_short(const calibrate::Calibration& calibration) {
  if (calibration.fits.empty()) return "";
  const calibrate::ModelFit& best = calibrate::best_fit(calibration);
  const calibrate::Metrics& v = best.validation;
  const int decimals = report::error_decimals(calibration);
  const std::string tests = report::count_of(v.n_experiments, "test");
  if (calibration.judged_by == calibrate::JudgedBy::fit)
    return fmt::format(
        "{} misses tau_R by {:.{}f} MPa on the test it is fitted to: no other judges it",
        best.model.law->name, v.mae_MPa, decimals);
  std::string text =
      fmt::format("{} misses tau_R by {:.{}f} MPa ({}) on {} it has not seen", best.model.law->name,
                  v.mae_MPa, decimals, range_of(v.mae_interval, decimals), tests);
  std::vector<std::string> others = calibrate::possibly_best(calibration.comparisons);
  std::erase(others, best.model.law->name);
  if (!others.empty()) text += "; the best may as well be " + report::list_of(others);
  const std::string& recommended = calibration.recommended.law;
  if (!recommended.empty() && recommended != best.model.law->name)
    text += "; recommended, as the simplest that is hardly worse: " + recommended;
  return text;
}

} // namespace frictab::run
