// Collects the answers of all stages.
#include "words/answer.h"

#include <fmt/format.h>

#include "calibrate/comparison.h"
#include "calibrate/recommended.h"
#include "words/drift.h"
#include "words/numbers.h"
#include "words/trace.h"

namespace frictab::words {

namespace {

// The best law, its error and the laws that may be as good.
Text best_law(const calibrate::Calibration& calibration) {
  const calibrate::ModelFit& best = calibrate::best_fit(calibration);
  const calibrate::Metrics& v = best.validation;
  const int decimals = error_decimals(calibration);
  const Text misses = strong(best.model.law->name) + " misses tau_R by " +
                      strong(fixed(v.mae_MPa, decimals) + " MPa");
  if (calibration.judged_by == calibrate::JudgedBy::fit)
    return misses + " on the test it is fitted to: no other judges it";
  Text text =
      misses + fmt::format(" ({}) on {} it has not seen", interval_text(v.mae_interval, decimals),
                           count_of(v.n_experiments, "test"));
  std::vector<std::string> others = calibrate::possibly_best(calibration.comparisons);
  std::erase(others, best.model.law->name);
  if (!others.empty()) text += "; the best may as well be " + list_of(others);
  const std::string& recommended = calibration.recommended.law;
  if (!recommended.empty() && recommended != best.model.law->name)
    text += "; recommended, as the simplest that is hardly worse: " + strong(recommended);
  return text;
}

} // namespace

Section in_short(const Answers& answers) {
  Section section{"verdict", "", "In short"};
  List list{{}, "findings"};
  const auto add = [&](const char* what, const Text& text) {
    if (!text.empty()) list.items.push_back(strong(what) + ": " + text);
  };
  if (answers.calibration && !answers.calibration->fits.empty())
    add("best law", best_law(*answers.calibration));
  else if (answers.calibration)
    add("best law", "no law was calibrated");
  if (answers.verification) add("tables", drift_in_short(*answers.verification));
  for (const trace::Trace& trace : answers.traces)
    add("missing", trace_in_short(trace));
  add("form", verify::forms_in_short(answers.forms));
  section.add(std::move(list));
  return section;
}

} // namespace frictab::words
