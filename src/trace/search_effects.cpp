// Between tests, within tests, between once more; then what follows the order of tests.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "trace/choose_effect.h"
#include "trace/order_search.h"

namespace frictab::trace {

namespace {

constexpr std::size_t most_effects_within = 4; // effects
constexpr std::size_t most_alternatives = 5; // of an effect between tests, that are fitted as well
constexpr double least_explained = 2;        // log likelihood within tests, beyond what it costs

class Tracer {
public:
  explicit Tracer(Search& search) : s_(search) {}

  void run() {
    find_all();
    if (find_order(s_)) find_all();
    drop_superseded();
    reconsider_order(s_);
    if (s_.campaign().quick) return; // a fold of nested cross-validation needs only the findings
    s_.last_screen = screen_within_tests(s_, true).result;
    s_.last_p_value = s_.negligible() ? 1 : s_.last_screen.p_value;
    s_.last_between = search_between_tests(s_, s_.input.options.alpha);
  }

private:
  void find_all() {
    find_between();
    std::size_t within = 0;
    while (within < most_effects_within && add_within())
      ++within;
    if (within > 0) find_between();
  }

  // --- between tests --------------------------------------------------------------------------

  void find_between() {
    while (!s_.negligible()) {
      BetweenResult result = search_between_tests(s_, s_.family_alpha());
      s_.doubtful = result.doubtful;
      if (result.found.empty()) return;
      const auto suspect =
          std::find_if(result.found.begin(), result.found.end(),
                       [&](const BetweenFinding& f) { return order_explains(s_, f.shape); });
      if (suspect == result.found.end()) {
        add_between(result);
        return;
      }
      attribute_to_order(s_, suspect->shape.cause, suspect->p_value);
      if (s_.order.found || !suspect->shape.cause.is_joint()) continue;
      // Too weak for a structure, and a product would be found again; what came before it stands.
      result.found.erase(suspect, result.found.end());
      if (!result.found.empty()) add_between(result);
      return;
    }
  }

  void add_between(const BetweenResult& result) {
    std::vector<effects::PlacedEffect> effects = s_.last().effects;
    std::vector<Cause> causes = s_.last().causes;
    const std::size_t before = effects.size();
    for (const BetweenFinding& finding : result.found) {
      effects.push_back(plain_effect(s_, finding.shape.cause));
      causes.push_back(finding.shape.cause);
    }
    s_.move_to(
        fit_rival(s_.campaign(), s_.last(), effects, causes, s_.last().noise, NoiseSearch::again));
    for (std::size_t i = 0; i < result.found.size(); ++i)
      s_.move_to(choose_form(s_, s_.last(), before + i).front());
    s_.fit_again();
    // Each finding keeps the law with the effects up to itself: nested cross-validation and
    // delivery ask what the first ones are worth without the later ones.
    std::vector<Finding> found;
    for (std::size_t i = 0; i < result.found.size(); ++i)
      found.push_back(finding_of(result.found[i], before + i));
    for (Finding& finding : found)
      s_.findings.push_back(std::move(finding));
  }

  Finding finding_of(const BetweenFinding& found, std::size_t index) const {
    Finding finding;
    finding.between = true;
    finding.p_value = found.p_value;
    finding.rival = up_to(index);
    for (const Cause& cause : found.as_good) {
      if (finding.others.size() >= most_alternatives) break;
      Rival other = finding.rival;
      std::vector<effects::PlacedEffect> effects = other.effects;
      effects.back() = plain_effect(s_, cause);
      std::vector<Cause> causes = other.causes;
      causes.back() = cause;
      finding.others.push_back(
          fit_rival(s_.campaign(), other, effects, causes, other.noise, NoiseSearch::kept));
      finding.in_set.push_back(true);
    }
    return finding;
  }

  // The law with the effects up to this one.
  Rival up_to(std::size_t index) const {
    const Rival& all = s_.last();
    if (index + 1 == all.effects.size()) return all;
    const auto count = static_cast<long>(index + 1);
    return fit_rival(s_.campaign(), all, {all.effects.begin(), all.effects.begin() + count},
                     {all.causes.begin(), all.causes.begin() + count}, all.noise,
                     NoiseSearch::again);
  }

  // --- within tests ---------------------------------------------------------------------------

  bool add_within() {
    if (s_.negligible() || !s_.enough_units()) return false;
    const auto [screened, noise] = screen_within_tests(s_);
    if (screened.directions.empty() || screened.p_value > s_.family_alpha()) return false;
    // Under the same noise, whatever is added has to be likelier than nothing.
    const Rival without = fit_rival(s_.campaign(), s_.last(), s_.last().effects, s_.last().causes,
                                    noise, NoiseSearch::kept);
    std::vector<Rival> rivals = choose_cause(s_, screened, noise);
    // A surface over two columns that nearly are one quantity may fit worse than no effect, since
    // its penalty is paid.
    std::erase_if(rivals, [&](const Rival& r) { return r.penalised <= without.penalised; });
    if (rivals.empty()) return false;
    prefer_declared(s_, rivals);
    if (follows_order(s_, rivals.front())) {
      attribute_to_order(s_, rivals.front().causes.back(), screened.p_value);
      return true;
    }
    const std::vector<Rival> forms =
        choose_form(s_, rivals.front(), rivals.front().effects.size() - 1);
    if (!(forms.front().penalised > without.penalised + least_explained)) return false;
    accept(std::move(rivals), forms.front(), screened);
    return true;
  }

  void accept(std::vector<Rival> rivals, const Rival& winner, const ScreenResult& screened) {
    Finding finding;
    finding.p_value = screened.p_value;
    finding.statistic = std::abs(screened.directions[screened.best].statistic);
    finding.threshold = screened.threshold(s_.family_alpha());
    finding.in_set = not_told_apart(rivals, s_.input.seed);
    finding.in_set.erase(finding.in_set.begin());
    finding.others.assign(rivals.begin() + 1, rivals.end());
    s_.move_to(fit_rival(s_.campaign(), winner, winner.effects, winner.causes, winner.noise,
                         NoiseSearch::again));
    finding.rival = s_.last();
    s_.findings.push_back(std::move(finding));
  }

  // --- at the end -----------------------------------------------------------------------------

  // Effects that later ones have made unnecessary.
  void drop_superseded() {
    for (std::size_t i = 0; s_.last().effects.size() > 1 && i < s_.last().effects.size();) {
      Rival without = without_effect(s_.campaign(), s_.last(), i);
      if (without.penalised < s_.last().penalised) {
        ++i;
        continue;
      }
      s_.rejected.push_back(
          fmt::format("{}: significant (p = {:.3g}), but explains nothing more once the later "
                      "effects are in",
                      cause_name(s_.last().causes[i], s_.candidates), s_.findings[i].p_value));
      s_.move_to(std::move(without));
      s_.findings.erase(s_.findings.begin() + static_cast<long>(i));
      for (std::size_t f = i; f < s_.findings.size(); ++f)
        s_.findings[f].rival = up_to(f);
    }
  }

  Search& s_;
};

} // namespace

std::unique_ptr<Search> search_effects(const TraceInput& input, const Effort& effort) {
  auto search = std::make_unique<Search>(input, effort);
  Tracer(*search).run();
  return search;
}

} // namespace frictab::trace
