// Says what a judgement of a process found.
#include "words/process.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/text.h"
#include "data/quantity.h"
#include "words/numbers.h"

namespace frictab::words {

using process::Assessment;
using process::LawThere;
using process::Prediction;
using process::Process;

namespace {

std::string percent_of(double share) {
  const double percent = 100 * share;
  return percent > 0 && percent < 0.95 ? fmt::format("{:.1f} %", percent)
                                       : fmt::format("{:.0f} %", percent);
}

std::string signed_percent(double percent) {
  const double size = std::abs(percent);
  const int decimals = size >= 20 ? 0 : size >= 1 ? 1 : 2;
  return fmt::format("{:+.{}f} %", percent, decimals);
}

std::string range_text(double low, double high) {
  if (signed_percent(low) == signed_percent(high)) return signed_percent(low);
  std::string from = signed_percent(low);
  from.resize(from.size() - 2); // one % for both
  return from + " to " + signed_percent(high);
}

std::string state_text(const std::string& state, double value, const std::string& unit) {
  const data::Quantity* quantity = data::find_quantity(state);
  return fmt::format("{} {}{}", quantity ? quantity->symbol : state, short_figures(value, 3),
                     unit.empty() || unit == "1" ? "" : " " + unit);
}

std::size_t count_if(const Assessment& v, bool (*test)(const LawThere&)) {
  return static_cast<std::size_t>(std::ranges::count_if(v.laws, test));
}

bool leads(const LawThere& law) {
  return law.leads;
}
bool not_ruled_out(const LawThere& law) {
  return law.leads || law.may_be_best;
}

std::string laws_of(std::size_t count) {
  return count == 1 ? "the law" : fmt::format("the {} laws", count);
}

// Why no change of force is predicted; empty: it is.
std::string no_force_text(const Process& p) {
  switch (p.prediction) {
  case Prediction::force:
    return "";
  case Prediction::no_tool:
    return "no force of the tool is given";
  case Prediction::force_driven:
    return p.driven_was_found ? "the tool seems to be driven by a force (it is a straight line "
                                "over time, the speed is not steady; process.driven says otherwise)"
                              : "the tool is driven by a force";
  case Prediction::energy_driven:
    return "the tool is driven by an energy";
  case Prediction::contact_changes:
    return "another friction makes another contact here";
  }
  return "";
}

// The side of a state on which most friction work lies outside the tests.
std::string most_outside(const Process& p) {
  double most = 0;
  std::string text;
  for (const process::StateCoverage& state : p.coverage.states) {
    if (state.below.work > most) {
      most = state.below.work;
      text = fmt::format("most of it below {} (from {})",
                         state_text(state.state, state.tested_low, state.unit),
                         short_figures(state.low, 3));
    }
    if (state.above.work > most) {
      most = state.above.work;
      text = fmt::format("most of it above {} (to {})",
                         state_text(state.state, state.tested_high, state.unit),
                         short_figures(state.high, 3));
    }
  }
  return text;
}

std::string read_text(const Process& p) {
  std::string text = fmt::format("{} at {} of {}", count_of(p.history.rows(), "contact"),
                                 count_of(p.history.time_s.size(), "increment"),
                                 count_of(p.history.facets, "facet"));
  if (p.work_share_percent > 0)
    text += fmt::format("; friction takes {:.0f} % of the tool's work", p.work_share_percent);
  if (p.work_check_percent)
    text += fmt::format(", {:+.1f} % against the solver's own sum", *p.work_check_percent);
  return text;
}

std::string where_text(const Process& p) {
  if (p.coverage.states.empty()) return "no state of the contact varies in the tests";
  std::string text =
      fmt::format("{} of the friction work is thinly tested (less than half a test nearby), {} "
                  "lies outside the tests' range",
                  percent_of(p.coverage.thin.work), percent_of(p.coverage.outside.work));
  if (const std::string most = most_outside(p); p.coverage.outside.work >= 0.005 && !most.empty())
    text += ", " + most;
  return text;
}

std::string laws_text(const Process& p, const Assessment& v) {
  const std::size_t leading = count_if(v, leads), possible = count_if(v, not_ruled_out);
  std::string text = fmt::format("{} that the tests favour {} {} of {}", laws_of(leading),
                                 leading == 1 ? "gives" : "give",
                                 range_text(v.low_percent, v.high_percent), result_name(p));
  if (possible > leading)
    text += fmt::format("; all {} that they do not rule out {}", possible,
                        range_text(v.all_low_percent, v.all_high_percent));
  return text;
}

Text take_text(const Process& p, const Assessment& v) {
  const LawThere& law = v.law_to_take();
  Text text = strong(law.law) + ": " + change_text(p, law.late_percent);
  if (v.resampled.draws > 0)
    text += fmt::format("; tests resampled, laws fitted and chosen again: {} (95 %)",
                        range_text(v.resampled.late_percent.low, v.resampled.late_percent.high));
  return text;
}

std::string matters_text(const Process& p, const Assessment& v) {
  if (v.resampled.draws == 0) return "";
  double own = 0;
  for (const process::Resampled::OfLaw& law : v.resampled.laws)
    if (law.law == v.take) own = law.sd_percent;
  const double choice = 0.5 * (v.high_percent - v.low_percent);
  std::string text =
      choice > own
          ? fmt::format("which law it is ({} of {} between them), more than the scatter of its "
                        "parameters ({:.1f} %)",
                        signed_percent(v.high_percent - v.low_percent).substr(1), result_name(p),
                        own)
          : fmt::format(
                "the scatter of {}'s parameters ({:.1f} % of {}), more than which law it is",
                v.take, own, result_name(p));
  if (v.parameter)
    text += fmt::format("; of these most {} ({})", v.parameter->parameter,
                        signed_percent(v.parameter->percent));
  return text;
}

std::string open_text(double sd) {
  return fmt::format("\u00B1{:.{}f} %", 100 * sd, sd < 0.095 ? 1 : 0);
}

std::string next_text(const Process& p) {
  const process::ProposedTests& t = p.proposed;
  if (t.tests.empty()) return "no tests can be proposed: " + t.why_none;
  double reached = 1;
  for (const process::OutOfReach& one : t.out_of_reach)
    reached = std::min(reached, 1 - one.share);
  const std::string where =
      reached > 0.99 ? "over this process"
                     : fmt::format("over the {} of its friction work that the rig reaches",
                                   percent_of(reached));
  return fmt::format("run {} of process_plan.csv: what any law may err in tau_R {} falls from {} "
                     "to {}; with as many tests of the campaign again to {}",
                     count_of(t.tests.size(), "test"), where, open_text(t.open),
                     open_text(t.with_tests), open_text(t.with_repeats));
}

std::string reach_text(const Process& p) {
  std::vector<std::string> parts;
  for (const process::OutOfReach& one : p.proposed.out_of_reach)
    parts.push_back(fmt::format("{} of the friction work {} {} (median {})", percent_of(one.share),
                                one.below ? "below" : "above",
                                state_text(one.state, one.limit, one.unit),
                                short_figures(one.median, 3)));
  return join(parts, "; ");
}

std::string held_text(const Process& p) {
  std::vector<std::string> parts;
  for (const process::Held& held : p.history.held) {
    std::string text =
        state_text(held.state, held.value, held.unit) + " everywhere (" + held.why + ")";
    if (held.high > held.low)
      text += fmt::format(", between {} and {} up to {:.1f} % of {}", short_figures(held.low, 3),
                          short_figures(held.high, 3), held.cost_percent, result_name(p));
    parts.push_back(std::move(text));
  }
  return join(parts, "; ");
}

void line(Section& section, const char* name, const Text& text) {
  if (!text.empty()) section.say(Text(std::string(name) + ": ") + text);
}

} // namespace

std::string result_name(const Process& p) {
  return p.prediction == Prediction::force ? "force" : "friction work";
}

std::string change_text(const Process& p, double percent) {
  if (p.prediction != Prediction::force)
    return signed_percent(percent) + " of friction work, with all motion held";
  if (std::abs(percent) > process::rerun_percent)
    return signed_percent(percent) + " of force: too large to be predicted, rerun it";
  const stats::Interval range = process::shown_range(percent);
  return fmt::format("{} of force (a rerun: {})", signed_percent(percent),
                     range_text(range.low, range.high));
}

Section process_in_short(const Process& p) {
  Section section{"short", "", "In short"};
  if (p.synthetic) section.say(strong("SYNTHETIC") + " tests");
  line(section, "read", read_text(p));
  line(section, "where", where_text(p));
  if (const std::string why = no_force_text(p); !why.empty())
    line(section, "force", "not predicted: " + why + "; friction work instead");
  const Assessment& v = p.latest();
  line(section, "laws",
       laws_text(p, p.assessment) + ", against " +
           (p.used.name.empty() ? std::string("the solver's stress") : p.used.name) +
           (p.prediction == Prediction::force ? " (late half of the stroke)" : " (late half)"));
  if (p.with_added) {
    line(section, "now",
         fmt::format("with {} more: ", count_of(p.with_added->tests - p.assessment.tests, "test")) +
             laws_text(p, v) +
             fmt::format("; what any law may err over the process: {} before, {} now",
                         open_text(p.assessment.open), open_text(v.open)));
    line(section, "before", take_text(p, p.assessment));
  }
  line(section, "take", take_text(p, v));
  line(section, "matters", matters_text(p, v));
  line(section, "held", held_text(p));
  if (!p.with_added) line(section, "next", next_text(p));
  line(section, "out of reach", reach_text(p));
  for (const std::string& caution : p.cautions)
    line(section, "caution", caution);
  return section;
}

namespace {

void add_state(Table& table, const process::StateCoverage& s, bool joint) {
  const data::Quantity& quantity = *data::find_quantity(s.state);
  const auto range = [](double low, double high) {
    return short_figures(low, 3) + " to " + short_figures(high, 3);
  };
  table.rows.push_back(
      {{Cell(symbol(quantity.symbol) + (s.unit == "1" ? "" : ", " + s.unit)),
        range(s.tested_low, s.tested_high), range(s.low, s.high), short_figures(s.median, 3),
        percent_of(s.below.work), percent_of(s.above.work), joint ? percent_of(s.thin.work) : "",
        percent_of(s.below.contact + s.above.contact)}});
}

void add_part(Table& table, const process::PartCoverage& part) {
  table.rows.push_back(
      {{part.name, percent_of(part.share), percent_of(part.outside), percent_of(part.thin)}});
}

} // namespace

Section process_coverage(const Process& p) {
  Section section{"where", "Where it rubs", "Where it rubs, compared with the tests"};
  section.say(where_text(p) + ".");
  section.say("Shares are of friction work; the last column of contact area x time. Thinly tested "
              "is a state with less than half a test's worth of rows within a quarter of what the "
              "tests span: tests are counted, not rows, since each test passes on its way through "
              "states that none was made for.",
              "", Shown::on_pages);
  Table states{"States of the process and of the tests",
               {{"state"},
                number_column("tests"),
                number_column("process (1 to 99 %)"),
                number_column("median"),
                number_column("below", "outside"),
                number_column("above", "outside"),
                number_column("thinly tested"),
                number_column("outside, of area x time")}};
  for (const process::StateCoverage& state : p.coverage.states)
    add_state(states, state, true);
  for (const process::StateCoverage& state : p.coverage.further)
    add_state(states, state, false);
  section.add(std::move(states));
  Table parts{"Parts of the process",
              {{"part"},
               number_column("of all friction work"),
               number_column("outside"),
               number_column("thinly tested")}};
  for (const process::PartCoverage& part : p.coverage.stroke)
    add_part(parts, part);
  for (const process::PartCoverage& part : p.coverage.surface)
    add_part(parts, part);
  section.add(std::move(parts));
  return section;
}

namespace {

std::string setting_text(const process::Setting& at) {
  std::vector<std::string> parts;
  for (std::size_t s = 0; s < at.size(); ++s)
    if (const char* name = process::setting_names[s]; std::isfinite(at[s]))
      parts.push_back(state_text(name, at[s], data::find_quantity(name)->unit));
  return join(parts, ", ");
}

std::string error_text(const Process& p, double percent) {
  if (p.prediction != Prediction::force) return "";
  if (std::abs(percent) > process::rerun_percent) return "rerun";
  const stats::Interval range = process::shown_range(percent);
  return range_text(range.low, range.high);
}

void add_law(Table& table, const Process& p, const Assessment& v, const LawThere& law) {
  double sd = -1;
  for (const process::Resampled::OfLaw& one : v.resampled.laws)
    if (one.law == law.law) sd = one.sd_percent;
  const char* note = law.leads         ? "leads"
                     : law.may_be_best ? "not ruled out"
                     : law.candidate   ? "ruled out by the tests"
                                       : "reference";
  Row row{{Cell(law.law == v.take ? strong(law.law) : Text(law.law), note), fixed(law.tau_MPa, 1),
           fixed(law.differs_MPa, 1), signed_percent(law.late_percent),
           error_text(p, law.late_percent), signed_percent(law.end_percent),
           sd < 0 ? "" : fmt::format("{:.1f} %", sd), percent_of(law.best_in),
           percent_of(law.near_error)}};
  table.rows.push_back(std::move(row));
}

} // namespace

Section process_laws(const Process& p) {
  const Assessment& v = p.latest();
  Section section{"laws", "What the laws say", "What the laws say there"};
  section.say(
      sentence(laws_text(p, v)) + " " +
      fmt::format(
          "Their stress differs by {:.1f} MPa (standard deviation between them, by friction work).",
          v.differ_MPa));
  Table table{"Laws in the process",
              {{"law"},
               number_column("mean, MPa", "tau_R"),
               number_column("off the used law, MPa", "tau_R"),
               number_column("late half", result_name(p)),
               number_column("in a rerun", result_name(p)),
               number_column("end", result_name(p)),
               number_column("scatter of tests", result_name(p)),
               number_column("best in resamples"),
               number_column("error near the process")}};
  for (const LawThere& law : v.laws)
    add_law(table, p, v, law);
  section.add(std::move(table));
  section.say(
      "A change of force is the change of friction power over the tool's speed, with all motion "
      "held: exact to first order where nothing else depends on friction. In a rerun: the range "
      "that nine in ten of the reruns of four processes (synthetic) stayed in; larger changes than "
      "10 % need a rerun. Scatter of tests: standard deviation over resampled tests, fitted again. "
      "Error near the process: relative, on the tests' rows by their nearness.",
      "", Shown::on_pages);
  return section;
}

Section process_tests(const Process& p) {
  Section section{"tests", "Tests", "Tests that would settle it"};
  const process::ProposedTests& t = p.proposed;
  if (t.tests.empty()) {
    section.say(sentence(next_text(p)));
    return section;
  }
  section.say(sentence(next_text(p)));
  Table table{"Proposed tests", {{"test"}, {"settings"}, {"run twice"}}};
  for (std::size_t i = 0; i < t.tests.size(); ++i) {
    const bool twice = std::ranges::find(t.repeated, i) != t.repeated.end();
    table.rows.push_back({{std::to_string(i + 1), setting_text(t.tests[i]), twice ? "yes" : ""}});
  }
  section.add(std::move(table));
  std::vector<std::string> centres;
  for (const process::Setting& centre : t.centres)
    centres.push_back(setting_text(centre));
  section.say(fmt::format(
      "Plainer, and nearly as good ({}): the centres of friction work, clipped to the rig: {}.",
      open_text(t.with_centres), join(centres, "; ")));
  std::vector<std::string> rig;
  for (const auto& [name, range] : t.rig)
    rig.push_back(fmt::format("{} {} to {}", name, short_figures(range.first, 4),
                              short_figures(range.second, 4)));
  section.say("Reach of the rig, which [process.rig] sets: " + join(rig, ", ") + ".");
  if (const std::string beyond = reach_text(p); !beyond.empty())
    section.say("No test of this rig reaches " + beyond + ".");
  return section;
}

Section process_reading(const Process& p) {
  Section section{"reading", "What was read", "What was read, and what not to conclude"};
  section.say(sentence(read_text(p)));
  List list;
  for (const std::string& note : p.history.notes)
    list.items.emplace_back(note);
  if (!p.history.held.empty()) list.items.emplace_back("held: " + held_text(p));
  if (p.used.solver_over_law > 0)
    list.items.emplace_back(fmt::format("the solver's shear stress is {:.3g} of {}'s in the middle "
                                        "of the friction work; other laws take that factor too",
                                        p.used.solver_over_law, p.used.name));
  if (!list.items.empty()) section.add(std::move(list));
  section.say("Of the shape, such as an inner diameter, only the sign of a change follows. Nothing "
              "follows where a force or an energy drives the tool, or where another friction makes "
              "another contact. That laws agree here does not mean that they are right here: they "
              "were all fitted to the same tests.",
              "", Shown::on_pages);
  return section;
}

} // namespace frictab::words
