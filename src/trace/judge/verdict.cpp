// Verdict, and sentences about the remaining structure.
#include "trace/judge/verdict.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/text.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

// Three digits: "12.6 %", "0.034 %".
std::string percent(double share) {
  return fmt::format("{:.3g} %", 100 * share);
}

bool scatters_more(const Trace& t) {
  return t.repeatability && t.scatter_at_least > *t.repeatability;
}

// Few repeats determine the repeatability poorly, so that the scatter would hardly ever exceed it
// significantly. So it must also be of about the same size.
bool agrees_with_repeats(const Trace& t) {
  return t.repeatability && !scatters_more(t) &&
         t.scatter_between <= tuning::repeatability_slack * *t.repeatability;
}

std::string scatter_sentence(const Trace& t) {
  if (t.noise_floor.n_experiments < 2) return "one test says nothing about how tests differ";
  std::string text = fmt::format("unexplained scatter between tests: {} (95 %: {} to {})",
                                 percent(t.scatter_between), percent(t.scatter_interval.low),
                                 percent(t.scatter_interval.high));
  if (std::isfinite(t.smallest_seen))
    text += fmt::format("; a column that splits the tests in halves would have been seen (80 %) "
                        "from {} on",
                        percent(t.smallest_seen));
  if (!t.repeatability)
    text += "; it is unknown whether this exceeds the rig's repeatability: repeat tests, or give "
            "trace.repeatability";
  return text;
}

std::string order_sentence(const OrderStructure& order) {
  return fmt::format(
      "{}, {:.2g} MPa or {} root mean square: drift, wear or batch; the law holds it "
      "at {}",
      order_text(order), order.size_MPa, percent(order.share), order.reference);
}

std::string worlds_sentence(const ValidationShift& worlds) {
  return fmt::format("the validation tests lie {:+.3g} MPa off the training tests as a whole "
                     "(95 %: {:+.3g} to {:+.3g} MPa, {:+.3g} %): another lubricant, tool, rig or "
                     "unit; errors on them say nothing about a law until that is settled",
                     worlds.shift_MPa, worlds.interval.low, worlds.interval.high,
                     100 * worlds.share);
}

std::string excess_sentence(const Trace& t) {
  return fmt::format("tests scatter by {} (at least {}, with 95 % confidence), more than the "
                     "repeatability of {} ({}): something that no column recorded differs between "
                     "them",
                     percent(t.scatter_between), percent(t.scatter_at_least),
                     percent(*t.repeatability),
                     t.repeatability_from == "given" ? "given" : "from repeated tests");
}

Verdict verdict_of(const Trace& t) {
  if (!t.effects.empty()) return Verdict::effect_added;
  if (t.remaining.structure) return Verdict::unexplained_structure;
  return agrees_with_repeats(t) ? Verdict::nothing_missing : Verdict::nothing_found;
}

} // namespace

std::string order_text(const OrderStructure& order) {
  if (order.change == 0)
    return fmt::format("friction follows the order of tests ({})", order.column);
  return fmt::format("friction {} by {:.2g} % {} ({})", order.change < 0 ? "falls" : "rises",
                     100 * std::abs(order.change),
                     order.step.empty() ? "from the first test to the last"
                                        : "between tests " + order.step,
                     order.column);
}

bool repeats_differ(const Trace& t) {
  return t.repeatability && t.repeatability_from != "given" &&
         *t.repeatability > tuning::largest_repeatability;
}

void add_verdict(Trace& t, const Found& found, bool contradicted) {
  const bool excess = scatters_more(t);
  contradicted = contradicted && t.effects.empty();
  t.remaining.p_value = found.leftover.p_value;
  t.remaining.structure =
      t.order.found || excess || t.validation_shift.found || contradicted || repeats_differ(t);
  std::vector<std::string> notes;
  if (t.validation_shift.found) notes.push_back(worlds_sentence(t.validation_shift));
  if (t.order.found) notes.push_back(order_sentence(t.order));
  if (excess) notes.push_back(excess_sentence(t));
  if (contradicted)
    notes.push_back("what the training tests show, the validation tests contradict");
  if (repeats_differ(t))
    notes.push_back(
        fmt::format("repeated tests scatter by {}, more than any rig: something that no "
                    "column recorded differs between them",
                    percent(*t.repeatability)));
  if (!excess) notes.push_back(scatter_sentence(t));
  t.remaining.note = join(notes, "; ");
  t.verdict = verdict_of(t);
}

} // namespace frictab::trace
