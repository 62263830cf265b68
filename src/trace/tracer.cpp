// Screens, attributes, adds and refits until nothing is left that noise could not be.
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/progress.h"
#include "trace/held_out.h"
#include "trace/order_search.h"

namespace frictab {

namespace {

constexpr std::size_t most_effects = 5;
constexpr double declared_lead = 10; // of log likelihood, that a declared wear may lack

class Tracer {
public:
  explicit Tracer(Search& search) : s_(search), progress_("tracing", most_effects + 2) {}

  void run() {
    while (add_one())
      progress_.tick();
    if (find_order(s_))
      while (!s_.candidates.order_column.empty() && add_one()) {
      }
    drop_what_does_not_pay();
    drop_superseded();
    reconsider_order(s_);
    forget_overruled();
    screen_what_is_left();
  }

private:
  bool add_one() {
    if (s_.findings.size() >= most_effects || s_.negligible()) return false;
    const ScreenResult screened = screen(s_);
    if (screened.directions.empty() || screened.p_value > s_.input.options.alpha) return false;
    std::vector<Rival> rivals =
        find_rivals(s_.campaign(), s_.last(), s_.causes, s_.shapes, screened, s_.tau_scale_MPa);
    prefer_declared(rivals);
    if (follows_order(s_, rivals.front()))
      blame_order(s_, rivals.front(), screened.p_value);
    else
      accept(std::move(rivals), screened);
    return true;
  }

  std::string name_of(const Rival& rival) const {
    return cause_name(rival.causes.back(), s_.candidates);
  }

  // Of two that follow the order of tests alike, the one that the user has declared.
  void prefer_declared(std::vector<Rival>& rivals) const {
    if (!constant_in_experiments(rivals.front().causes.back(), s_.candidates)) return;
    const auto found = std::find_if(rivals.begin(), rivals.end(),
                                    [&](const Rival& r) { return is_declared(s_, r); });
    if (found != rivals.end() && found->penalised > rivals.front().penalised - declared_lead)
      std::rotate(rivals.begin(), found, found + 1);
  }

  void accept(std::vector<Rival> rivals, const ScreenResult& screened) {
    Finding finding;
    finding.p_value = screened.p_value;
    finding.statistic = std::abs(screened.directions[screened.best].statistic);
    finding.threshold = screened.threshold(s_.input.options.alpha);
    std::set<Cause> seen;
    std::vector<Rival> best; // of each cause
    for (Rival& rival : rivals)
      if (seen.insert(rival.causes.back()).second) best.push_back(std::move(rival));
    best.front() =
        find_forms(s_.campaign(), s_.last(), best.front(), s_.causes, s_.shapes, screened).front();
    finding.in_set = not_told_apart(best, s_.input.seed);
    finding.in_set.erase(finding.in_set.begin());
    finding.rival = best.front();
    finding.others.assign(best.begin() + 1, best.end());
    s_.move_to(finding.rival);
    s_.findings.push_back(std::move(finding));
  }

  // The last ones, as long as they do not pay.
  void drop_what_does_not_pay() {
    auto& findings = s_.findings;
    while (!findings.empty()) {
      const Rival& before = findings.size() > 1 ? findings[findings.size() - 2].rival : s_.base;
      const Payment payment = paid(before, findings.back().rival);
      if (payment.enough) break;
      reject(findings.size() - 1, payment);
      findings.pop_back();
    }
    s_.move_to(findings.empty() ? s_.base : findings.back().rival);
  }

  // Effects that later ones have made unnecessary, or that do not pay beside them.
  void drop_superseded() {
    bool dropped = true;
    while (dropped && s_.last().effects.size() > 1) {
      dropped = false;
      for (std::size_t i = 0; i < s_.last().effects.size() && !dropped; ++i) {
        Rival without = without_effect(s_.campaign(), s_.last(), i);
        const Payment payment = paid(without, s_.last());
        if (without.penalised < s_.last().penalised && payment.enough) continue;
        reject(i, payment);
        s_.move_to(std::move(without));
        s_.findings.erase(s_.findings.begin() + static_cast<long>(i));
        dropped = true;
      }
    }
    if (s_.order.found || !s_.findings.empty()) s_.fit_again();
  }

  struct Payment {
    double without_MPa, with_MPa; // errors of cross-validation
    bool enough;
  };
  Payment paid(const Rival& without, const Rival& with) const {
    const Eigen::VectorXd a = held_out_errors(s_.campaign(), without, s_.input.seed);
    const Eigen::VectorXd b = held_out_errors(s_.campaign(), with, s_.input.seed);
    return {a.sum(), b.sum(), pays(a, b)};
  }

  void reject(std::size_t finding, const Payment& payment) {
    const Finding& f = s_.findings[finding];
    const std::string text =
        fmt::format("{}: significant (p = {:.3g}), but ", name_of(f.rival), f.p_value);
    s_.rejected.push_back(
        text + (payment.enough
                    ? "explains nothing more once the later effects are in"
                    : fmt::format("no gain in cross-validation over experiments ({:.3f} against "
                                  "{:.3f} MPa)",
                                  payment.with_MPa, payment.without_MPa)));
  }

  // What was turned down first and added later.
  void forget_overruled() {
    for (const Cause& cause : s_.last().causes)
      std::erase_if(s_.rejected, [&](const std::string& text) {
        return text.starts_with(cause_name(cause, s_.candidates) + ":");
      });
  }

  void screen_what_is_left() {
    // (Before the parameters are delivered: the test belongs to the noise model's weights.)
    s_.last_screen = screen(s_, true);
    s_.last_p_value = s_.negligible() ? 1 : s_.last_screen.p_value;
    s_.base = delivered(s_.campaign(), s_.base, s_.input.seed);
    s_.move_to(s_.last().effects.empty() && !s_.order.found
                   ? s_.base
                   : delivered(s_.campaign(), s_.last(), s_.input.seed));
  }

  Search& s_;
  Progress progress_;
};

} // namespace

std::unique_ptr<Search> search_effects(const TraceInput& input) {
  auto search = std::make_unique<Search>(input);
  Tracer(*search).run();
  return search;
}

} // namespace frictab
