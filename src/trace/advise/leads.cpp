// Selects the strongest unexplained terms, with sizes and the tests that would confirm them.
#include "trace/advise/leads.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include "calibrate/metrics.h"
#include "core/error.h"
#include "core/no_value.h"
#include "core/text.h"
#include "data/roles.h"
#include "trace/advise/design.h"
#include "trace/search/order_search.h"
#include "trace/tuning.h"

namespace frictab::trace {

namespace {

constexpr std::size_t most_leads = 6, most_left = 3;
constexpr const char* speed = "v_rel_mm_s";

bool is_listed(const Trace& trace, const Lead& lead) {
  const auto same = [&](const auto& other) {
    return other.columns == lead.columns && other.derived == lead.derived;
  };
  return std::ranges::any_of(trace.leads, same) || std::ranges::any_of(trace.effects, same);
}

bool too_few_tests(const Trace& trace) {
  return trace.least_p_value > trace.alpha;
}

// Whether the lead is the strongest one, and chance is not its simplest explanation.
bool deserves_design(const Trace& trace, const Lead& lead) {
  return trace.leads.empty() && (lead.p_value < tuning::chance_p_value || too_few_tests(trace));
}

Lead lead_on(const Search& search, const Cause& cause, std::string form, bool between,
             double p_value) {
  Lead lead = lead_of(cause, search.candidates());
  lead.form = std::move(form);
  lead.between = between;
  lead.p_value = p_value;
  return lead;
}

void add_lead(Trace& trace, Lead lead, std::size_t most = most_leads) {
  if (trace.leads.size() < most && !is_listed(trace, lead)) trace.leads.push_back(std::move(lead));
}

// --- findings that are not delivered ------------------------------------------------------------

// Standard deviation over rows; for a text column, whether it varies.
double spread_of(const data::Column& column) {
  const auto [least, most] = std::ranges::minmax_element(column.values);
  if (!column.levels.empty()) return *most > *least;
  const Eigen::Map<const VectorXd> values(column.values.data(), column.values.size());
  return std::sqrt((values.array() - values.mean()).square().mean());
}

// Names columns that the validation tests hardly vary, so that they cannot show their effect.
std::string not_varied(const TraceInput& in, const std::vector<std::string>& columns) {
  std::string names;
  for (const std::string& name : columns) {
    const data::Column *here = in.training.find(name), *there = in.validation.find(name);
    if (here && there && spread_of(*there) < tuning::small_share_of_spread * spread_of(*here))
      names += (names.empty() ? "" : ", ") + name;
  }
  return names.empty() ? "" : "; the validation tests hardly vary " + names;
}

// Fills the errors of a lead; leaves them unknown if the stress of a history of itself does not
// converge.
void add_errors(Lead& lead, const Search& search, const Rival& without, const Rival& with) {
  const data::Dataset& training = search.input().training;
  const auto mae = [&](const Rival& rival) {
    const auto predicted = calibrate::predict(search.model_of(rival), training);
    return calibrate::metrics(training, predicted, 0, search.input().seed).mae_MPa;
  };
  try {
    const double before = mae(without);
    lead.with_MPa = mae(with);
    lead.without_MPa = before;
  } catch (const InputError&) {
  }
}

void add_undelivered(Trace& trace, const Found& found, const Delivery& delivery) {
  const Search& search = found.search;
  for (const auto& [index, against] : delivery.against) {
    const Finding& finding = found.findings[index];
    Lead lead = lead_on(search, finding.cause(), finding.rival.effects.back().form->name,
                        finding.between, finding.p_value);
    lead.significant = true;
    add_errors(lead, search, index == 0 ? search.base() : found.findings[index - 1].rival,
               finding.rival);
    lead.why = against.why;
    if (against.by_validation) lead.why += not_varied(search.input(), lead.columns);
    if (trace.leads.empty()) lead.design = design_for(search, finding);
    if (trace.leads.empty() && lead.design.tests.empty() && lead.between)
      lead.design = design_in_turn(search, finding.cause(), "");
    trace.leads.push_back(std::move(lead));
  }
}

// --- causes that the order of tests explains as well --------------------------------------------

// Friction by level, against the first, or over the range of a number: of whole tests, by the law
// without effects.
std::string size_between(const Search& search, const Cause& cause) {
  const CandidateColumn& column = search.candidates().first_of(cause);
  const VectorXd y = log_gains(search, search.base().predicted),
                 x = search.blocks().experiment_means(column.values).col(0);
  if (column.levels.empty()) {
    const VectorXd centred = x.array() - x.mean();
    const double change = centred.dot(y) / centred.squaredNorm() * (x.maxCoeff() - x.minCoeff());
    return fmt::format("friction {:+.2g} % from {:.4g} to {:.4g}", 100 * std::expm1(change),
                       x.minCoeff(), x.maxCoeff());
  }
  constexpr std::size_t most_shown = 4;
  std::vector<double> sum(column.levels.size()), tests(column.levels.size());
  for (Index e = 0; e < x.size(); ++e) {
    sum[static_cast<std::size_t>(x(e))] += y(e);
    ++tests[static_cast<std::size_t>(x(e))];
  }
  const auto first = static_cast<std::size_t>(
      std::ranges::find_if(tests, [](double n) { return n > 0; }) - tests.begin());
  std::vector<std::string> changes;
  for (std::size_t l = first + 1; l < tests.size() && changes.size() < most_shown; ++l)
    if (tests[l] > 0)
      changes.push_back(
          fmt::format("{} {:+.2g} %", column.levels[l],
                      100 * std::expm1(sum[l] / tests[l] - sum[first] / tests[first])));
  return "friction against " + column.levels[first] + ": " + join(changes, ", ");
}

void add_confounded(Trace& trace, const Found& found) {
  for (const auto& [cause, p_value] : found.confounded) {
    Lead lead = lead_on(found.search, cause, "between tests", true, p_value);
    lead.significant = true;
    const bool in_stretches = along_order(found.search, cause.columns[0]) != AlongOrder::no;
    lead.why =
        fmt::format("p = {:.2g}; {}, but {} ({})", p_value, size_between(found.search, cause),
                    in_stretches ? "it changed along the order of tests and never back, and so may "
                                   "anything else have done"
                                 : "a drift over the order of tests explains it as well",
                    found.order.column);
    if (trace.leads.empty())
      lead.design =
          design_in_turn(found.search, cause, order_name(found.search), trace.scatter_between);
    // without the limit on the number of leads
    add_lead(trace, std::move(lead), trace.leads.size() + 1);
  }
}

// --- unexplained terms --------------------------------------------------------------------------

// Slope of y over the logarithm of the speed within tests; NaN if the speed does not vary.
double per_e_fold(const Search& search, const VectorXd& y) {
  const VectorXd& v = search.candidates().by_symbol.at(speed);
  double xy = 0, xx = 0;
  for (std::size_t e = 0; e < search.blocks().experiments(); ++e) {
    std::vector<std::pair<double, double>> points;
    for (std::size_t b = search.first()[e]; b < search.first()[e + 1]; ++b)
      if (const double speed_here = v(b); speed_here > 0)
        points.emplace_back(std::log(speed_here), y(b));
    double mx = 0, my = 0;
    for (const auto& [x, value] : points) {
      mx += x / static_cast<double>(points.size());
      my += value / static_cast<double>(points.size());
    }
    for (const auto& [x, value] : points) {
      xy += (x - mx) * (value - my);
      xx += (x - mx) * (x - mx);
    }
  }
  return xx > 0 ? xy / xx : no_value;
}

// Change of the friction coefficient per e-fold of the speed, for the law as it is and with the
// lead: a - b of rate-and-state friction.
std::string rate_sentence(const Search& search, const VectorXd& change) {
  const auto sigma = search.candidates().by_symbol.find("sigma_n_MPa");
  if (sigma == search.candidates().by_symbol.end() || !search.candidates().by_symbol.count(speed))
    return "";
  const VectorXd mu =
      search.last().predicted.cwiseQuotient(sigma->second.cwiseMax(tuning::smallest_divisor));
  const double lead = per_e_fold(search, mu.cwiseProduct(change)), law = per_e_fold(search, mu);
  if (!std::isfinite(lead)) return "";
  const std::string with_law =
      std::abs(law) > tuning::smallest_rate_named ? fmt::format(", {:+.2g} by the law", law) : "";
  return fmt::format("; mu changes by {:+.2g} per e-fold of speed{} (a - b, in the words of "
                     "rate-and-state friction)",
                     lead, with_law);
}

bool follows_speed(const Search& search, const Cause& cause) {
  return search.candidates().recorded_of(cause) == std::vector<std::string>{speed};
}

// Number of tests needed for a p-value at which an effect is added.
std::string too_few(const Trace& trace, std::size_t tests) {
  if (!too_few_tests(trace)) return "";
  return fmt::format("; {} can give no p below {:.2g}: it takes {:.0f} that show it to add an "
                     "effect",
                     tests == 1 ? "one test" : fmt::format("{} tests", tests), trace.least_p_value,
                     tests_for(trace.alpha));
}

Lead lead_from(const Trace& trace, const Search& search, const Left& left) {
  Lead lead = lead_on(search, left.cause, left.effect.form->name,
                      constant_in_experiments(left.cause, search.candidates()), left.p_value);
  lead.share = left.change.maxCoeff() - left.change.minCoeff();
  lead.why = fmt::format("p = {:.2g} over all that was tried{}", left.p_value,
                         too_few(trace, search.blocks().experiments()));
  if (too_few_tests(trace) && follows_speed(search, left.cause))
    lead.why += rate_sentence(search, left.change);
  if (deserves_design(trace, lead))
    lead.design = design_for_lead(search, left.effect, left.cause, left.threshold);
  return lead;
}

// Terms shown if there are few tests: single quantities; of those from the same recorded columns
// one, the recorded one if it is among them.
std::vector<const Left*> plain_ones(const Found& found) {
  std::vector<const Left*> plain;
  const auto column = [&](const Left& left) -> const CandidateColumn& {
    return found.search.candidates().first_of(left.cause);
  };
  for (const Left& left : found.leftover.left) {
    if (left.cause.is_joint()) continue;
    const auto same = std::ranges::find_if(
        plain, [&](const Left* other) { return column(*other).recorded == column(left).recorded; });
    if (same == plain.end())
      plain.push_back(&left);
    else if (!column(left).derived)
      *same = &left;
  }
  return plain;
}

void add_what_is_left(Trace& trace, const Found& found) {
  std::vector<const Left*> all;
  for (const Left& left : found.leftover.left)
    all.push_back(&left);
  if (too_few_tests(trace)) all = plain_ones(found);
  const std::size_t enough = trace.leads.size() + most_left;
  for (std::size_t i = 0; i < all.size() && trace.leads.size() < enough; ++i)
    add_lead(trace, lead_from(trace, found.search, *all[i]));
}

// --- columns that may follow from friction -------------------------------------------------------

// A t-test, and the slope of the residual over a column.
struct Followed {
  double p_value = 1, slope = 0;
};

double p_of_t(double t, double degrees) {
  return std::isfinite(t) ? 2 * gsl_cdf_tdist_Q(std::abs(t), degrees) : 1;
}

// Subtracts the mean of each test.
VectorXd within_tests(const stats::Blocks& blocks, VectorXd x) {
  for (std::size_t e = 0; e < blocks.experiments(); ++e) {
    auto part = blocks.part(x, e);
    part.array() -= part.mean();
  }
  return x;
}

Followed look_within(const stats::Blocks& blocks, const VectorXd& x, const VectorXd& residual) {
  const VectorXd products = within_tests(blocks, x).cwiseProduct(within_tests(blocks, residual));
  const VectorXd scores = blocks.experiment_means(products);
  const double size = within_tests(blocks, x).squaredNorm(), n = static_cast<double>(scores.size());
  if (!(size > 0)) return {};
  const double spread = std::sqrt((scores.array() - scores.mean()).square().sum() / (n - 1));
  return {p_of_t(scores.mean() * std::sqrt(n) / spread, n - 1), products.sum() / size};
}

Followed look_between(const stats::Blocks& blocks, const VectorXd& x, const VectorXd& residual) {
  const VectorXd of_x = blocks.experiment_means(x), of_residual = blocks.experiment_means(residual);
  const VectorXd a = of_x.array() - of_x.mean(), b = of_residual.array() - of_residual.mean();
  const double size = a.squaredNorm(), n = static_cast<double>(a.size());
  if (!(size > 0)) return {};
  const double slope = a.dot(b) / size, left = (b - slope * a).squaredNorm();
  return {p_of_t(slope * std::sqrt(size * (n - 2) / left), n - 2), slope};
}

Lead lead_of_follower(const data::Column& column, const VectorXd& x, const Followed& looked,
                      bool is_between) {
  Lead lead;
  lead.name = column.name;
  lead.columns = {column.name};
  lead.form = is_between ? "between tests" : "within tests";
  lead.between = is_between;
  lead.p_value = looked.p_value;
  lead.share = looked.slope * (x.maxCoeff() - x.minCoeff());
  lead.why = fmt::format("p = {:.2g}, but it {}: it may follow from friction; where it does not, "
                         "[data.roles] \"{}\" = \"setting\" lets it be a cause",
                         looked.p_value,
                         column.role == data::Role::outcome ? "is known only after the test"
                                                            : "was measured along with friction",
                         column.name);
  return lead;
}

// Returns channels and outcomes (data/roles.h) that correlate with the residual of `rival`,
// strongest first: within tests by one score per test, between tests by test means, each with a
// t-test. The p-values are corrected for all comparisons (Bonferroni); leads have at most
// trace.alpha.
std::vector<Lead> leads_that_may_follow(const Search& search, const Rival& rival) {
  std::vector<Lead> leads;
  if (search.blocks().experiments() < tuning::fewest_tests_for_followers) return leads;
  const VectorXd& measured = search.campaign().measured;
  const double scale = tuning::smallest_share_of_tau * search.tau_scale_MPa();
  const VectorXd residual =
      (measured - rival.predicted).cwiseQuotient(rival.predicted.cwiseMax(scale));
  double looks = 0;
  for (const data::Column& column : search.input().training.columns) {
    if (!data::may_follow_friction(column.role) || !column.levels.empty()) continue;
    const VectorXd x = search.blocks().mean(column.values);
    if (!x.allFinite()) continue;
    for (const bool is_between : {false, true}) {
      const Followed looked = is_between ? look_between(search.blocks(), x, residual)
                                         : look_within(search.blocks(), x, residual);
      looks += looked.slope != 0;
      if (looked.slope != 0) leads.push_back(lead_of_follower(column, x, looked, is_between));
    }
  }
  std::erase_if(
      leads, [&](const Lead& lead) { return lead.p_value * looks > search.input().options.alpha; });
  std::ranges::stable_sort(leads, {}, &Lead::p_value);
  return leads;
}

} // namespace

void add_leads(Trace& trace, const Found& found, const Delivery& delivery) {
  add_undelivered(trace, found, delivery);
  add_confounded(trace, found);
  if (found.search.negligible()) return;
  add_what_is_left(trace, found);
  for (Lead& lead : leads_that_may_follow(found.search, delivery.rival))
    add_lead(trace, std::move(lead));
}

Lead lead_of(const Cause& cause, const Candidates& candidates) {
  Lead lead;
  lead.name = cause_name(cause, candidates);
  lead.columns = candidates.recorded_of(cause);
  for (const CandidateColumn* column : candidates.of(cause))
    if (column->derived) lead.derived += (lead.derived.empty() ? "" : ", ") + column->name;
  return lead;
}

} // namespace frictab::trace
