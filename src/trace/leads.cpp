// The strongest of what is left, with its size and what would make it evidence.
#include "trace/leads.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gsl/gsl_cdf.h>

#include "core/no_value.h"
#include "trace/choose_effect.h"
#include "trace/delivery.h"
#include "trace/design.h"
#include "trace/followers.h"

namespace frictab::trace {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t most_leads = 6, most_within = 3, most_doubtful = 3;
constexpr double by_chance = 0.2;   // p-value from which chance is the simplest reading
constexpr float as_strong = 0.8f;   // statistic of a recorded column, of what is computed from it
constexpr double hardly_there = 10; // of tau_R: the amplitude of a direction with nothing in it
constexpr const char* speed = "v_rel_mm_s";

bool is_listed(const Trace& trace, const Lead& lead) {
  const auto same = [&](const auto& other) {
    return other.columns == lead.columns && other.derived == lead.derived;
  };
  return std::any_of(trace.leads.begin(), trace.leads.end(), same) ||
         std::any_of(trace.effects.begin(), trace.effects.end(), same);
}

bool too_few_tests(const Trace& trace) {
  return trace.least_p_value > trace.alpha;
}

// The strongest lead, where chance is not the simplest reading of it.
bool deserves_design(const Trace& trace, const Lead& lead) {
  return trace.leads.empty() && (lead.p_value < by_chance || too_few_tests(trace));
}

void add_lead(Trace& trace, Lead lead, std::size_t most = most_leads) {
  if (trace.leads.size() < most && !is_listed(trace, lead)) trace.leads.push_back(std::move(lead));
}

// --- what the order of tests explains as well --------------------------------------------------

void add_confounded(Trace& trace, const Search& search) {
  for (const Search::Confounded& found : search.confounded) {
    Lead lead = lead_of(search, found.cause);
    lead.form = found.between ? "between tests" : "within tests";
    lead.between = found.between;
    lead.p_value = found.p_value;
    lead.why = fmt::format("p = {:.2g}, but a drift over the order of tests ({}) explains it as "
                           "well",
                           found.p_value, search.order.column);
    if (trace.leads.empty())
      lead.design = design_in_turn(search, found.cause, trace.scatter_between);
    add_lead(trace, std::move(lead), trace.leads.size() + 1); // none of these is left out
  }
}

// --- between tests ----------------------------------------------------------------------------

// Normal quantile of the family's error, shared by its columns.
double between_threshold(const Search& search) {
  std::set<Cause> causes;
  for (const TestShape& shape : search.test_shapes)
    causes.insert(shape.cause);
  const auto count = static_cast<double>(std::max<std::size_t>(causes.size(), 1));
  return gsl_cdf_ugaussian_Qinv(search.input.options.alpha / (2 * count));
}

void add_between_lead(Trace& trace, const Search& search, const TestShape& shape, double p_value,
                      const std::string& why) {
  Lead lead = lead_of(search, shape.cause);
  lead.form = shape.form;
  lead.between = true;
  lead.p_value = p_value;
  lead.why = why;
  if (deserves_design(trace, lead))
    lead.design = design_for_lead(search, plain_effect(search, shape.cause), shape.cause,
                                  between_threshold(search));
  add_lead(trace, std::move(lead));
}

std::string why_doubtful(const Search& search, const Doubtful& doubtful) {
  std::vector<std::string> others;
  for (const TestShape& shape : doubtful.beside)
    others.push_back(lead_of(search, shape.cause).name);
  const std::string path =
      others.empty() ? "" : fmt::format(" together with {}", fmt::join(others, " and "));
  const std::string doubt =
      doubtful.few_tests
          ? "but few tests, which scatter more than the others, carry it"
          : fmt::format("and is not sure beside {}", others.size() == 1 ? "it" : "them");
  return fmt::format("p = {:.2g} over all columns between tests{}, {}", doubtful.p_value, path,
                     doubt);
}

void add_between_leads(Trace& trace, const Search& search) {
  const auto some = std::min(search.doubtful.size(), most_doubtful);
  for (const Doubtful& one : std::span(search.doubtful).first(some))
    add_between_lead(trace, search, one.shape, one.p_value, why_doubtful(search, one));
  const double p = search.last_between.last_p_value;
  for (const TestShape& shape : search.last_between.leads)
    add_between_lead(trace, search, shape, p,
                     fmt::format("p = {:.2g} over all columns between tests", p));
}

// --- within tests -----------------------------------------------------------------------------

// Best direction of each cause, strongest first.
std::vector<std::size_t> strongest(const Search& search) {
  const std::vector<Direction>& all = search.last_screen.directions;
  std::map<std::size_t, std::size_t> best; // by cause
  for (std::size_t d = 0; d < all.size(); ++d) {
    const auto [at, is_new] = best.try_emplace(all[d].cause, d);
    if (!is_new && std::abs(all[d].statistic) > std::abs(all[at->second].statistic)) at->second = d;
  }
  std::vector<std::size_t> sorted;
  for (const auto& [cause, d] : best)
    sorted.push_back(d);
  std::stable_sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(all[a].statistic) > std::abs(all[b].statistic);
  });
  return sorted;
}

// With few tests: single quantities only, and one of those that come from the same recorded
// columns.
std::vector<std::size_t> plain_ones(const Search& search, const std::vector<std::size_t>& sorted) {
  const std::vector<Direction>& all = search.last_screen.directions;
  std::vector<std::size_t> plain;
  std::map<std::vector<std::string>, std::size_t> at; // in `plain`
  for (const std::size_t d : sorted) {
    const Cause& cause = search.causes[all[d].cause];
    if (cause.is_joint()) continue;
    const CandidateColumn& column = search.candidates.columns[cause.columns[0]];
    const auto [found, is_new] = at.try_emplace(column.recorded, plain.size());
    if (is_new) {
      plain.push_back(d);
      continue;
    }
    std::size_t& kept = plain[found->second];
    if (!column.derived && std::abs(all[d].statistic) > as_strong * std::abs(all[kept].statistic))
      kept = d;
  }
  return plain;
}

// Slope of y over the logarithm of the speed, within tests; NaN where the speed does not vary.
double per_e_fold(const Search& search, const VectorXd& y) {
  const VectorXd& v = search.candidates.by_symbol.at(speed);
  double xy = 0, xx = 0;
  for (std::size_t e = 0; e < search.blocks.experiments(); ++e) {
    std::vector<std::pair<double, double>> points;
    for (std::size_t b = search.first()[e]; b < search.first()[e + 1]; ++b)
      if (const double speed_here = v(static_cast<Index>(b)); speed_here > 0)
        points.emplace_back(std::log(speed_here), y(static_cast<Index>(b)));
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

// Change of the friction coefficient per e-fold of the speed, of the law as it is and of the lead:
// what rate-and-state friction calls a - b.
std::string rate_sentence(const Search& search, const Direction& d, double amplitude) {
  const auto sigma = search.candidates.by_symbol.find("sigma_n_MPa");
  if (sigma == search.candidates.by_symbol.end() || !search.candidates.by_symbol.count(speed))
    return "";
  const VectorXd of_lead =
      amplitude * search.shapes[d.cause][d.shape].direction.cast<double>().cwiseProduct(
                      search.sensitivities()[d.site]);
  const VectorXd pressure = sigma->second.cwiseMax(1e-300);
  const double lead = per_e_fold(search, of_lead.cwiseQuotient(pressure));
  const double law = per_e_fold(search, search.last().predicted.cwiseQuotient(pressure));
  if (!std::isfinite(lead)) return "";
  const std::string with_law =
      std::abs(law) > 1e-9 ? fmt::format(", beside {:+.2g} by the law", law) : "";
  return fmt::format("; mu changes by {:+.2g} per e-fold of speed{} (a - b, in the words of "
                     "rate-and-state friction)",
                     lead, with_law);
}

bool follows_speed(const Search& search, const Cause& cause) {
  return std::all_of(cause.columns.begin(), cause.columns.end(), [&](std::size_t c) {
    return search.candidates.columns[c].recorded == std::vector<std::string>{speed};
  });
}

// How many tests it takes for a p-value at which an effect is added.
std::string too_few(const Trace& trace, std::size_t tests) {
  if (!too_few_tests(trace)) return "";
  return fmt::format("; {} can give no p below {:.2g}: it takes {:.0f} that show it to add an "
                     "effect",
                     tests == 1 ? "one test" : fmt::format("{} tests", tests), trace.least_p_value,
                     tests_for(trace.alpha));
}

Lead within_lead(const Trace& trace, const Search& search, std::size_t index) {
  const Direction& d = search.last_screen.directions[index];
  const GridShape& shape = search.shapes[d.cause][d.shape];
  Lead lead = lead_of(search, search.causes[d.cause]);
  lead.form = shape.effect.form->name;
  lead.p_value = search.last_p_value;
  const double scores =
      static_cast<double>(search.last_screen.scores.col(static_cast<Index>(index)).sum());
  const double amplitude = scores / static_cast<double>(std::max(d.size, 1e-30f));
  lead.share =
      amplitude * static_cast<double>(shape.direction.maxCoeff() - shape.direction.minCoeff());
  if (!(std::abs(lead.share) < hardly_there)) lead.share = 0;
  const bool one_row_each = search.blocks.count() == search.blocks.experiments();
  lead.why = fmt::format("p = {:.2g} over all {}{}", search.last_p_value,
                         one_row_each ? "pairs of quantities" : "that changes within tests",
                         too_few(trace, search.blocks.experiments()));
  if (too_few_tests(trace) && follows_speed(search, search.causes[d.cause]))
    lead.why += rate_sentence(search, d, amplitude);
  if (deserves_design(trace, lead))
    lead.design = design_for_lead(search, shape.effect, search.causes[d.cause],
                                  search.last_screen.threshold(search.input.options.alpha));
  return lead;
}

void add_within_leads(Trace& trace, const Search& search) {
  std::vector<std::size_t> sorted = strongest(search);
  if (too_few_tests(trace)) sorted = plain_ones(search, sorted);
  const std::size_t enough = trace.leads.size() + most_within;
  for (std::size_t i = 0; i < sorted.size() && trace.leads.size() < enough; ++i)
    add_lead(trace, within_lead(trace, search, sorted[i]));
}

} // namespace

void add_leads(Trace& trace, const Search& search, const Rival& delivered) {
  add_confounded(trace, search);
  add_between_leads(trace, search);
  if (search.negligible()) return;
  add_within_leads(trace, search);
  for (Lead& lead : leads_that_may_follow(search, delivered))
    add_lead(trace, std::move(lead));
}

} // namespace frictab::trace
