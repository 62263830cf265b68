// All terms at once; then structure along the order of tests.
#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "trace/search/choose_effect.h"
#include "trace/search/joint.h"
#include "trace/search/order_search.h"

namespace frictab::trace {

namespace {

class Tracer {
public:
  explicit Tracer(Search& search) : s_(search) {}

  void run() {
    find_all();
    find_order(s_);
    reconsider_order(s_);
  }

private:
  void find_all() {
    if (s_.negligible()) return;
    JointResult result = find_jointly(s_);
    s_.leftover = std::move(result.leftover);
    s_.pays = result.pays;
    s_.folds = result.folds;
    for (const JointFinding& finding : result.dropped)
      s_.rejected.push_back(fmt::format(
          "{}: significant (p = {:.3g}), but predicts tests that are left out no better "
          "together with the others",
          cause_name(finding.cause, s_.candidates), finding.p_value));
    for (const JointFinding& finding : result.unsure)
      s_.rejected.push_back(
          fmt::format("{}: significant (p = {:.3g}), but few tests, which scatter more than the "
                      "others, carry it",
                      cause_name(finding.cause, s_.candidates), finding.p_value));
    if (!result.found.empty()) add(result);
    for (const JointFinding& one : result.without_walk)
      if (!is_in(one.cause)) note_confounded(s_, one.suspects, one.p_value);
  }

  // Adds all findings with the causes that the search names; then compares each with those near it.
  void add(const JointResult& result) {
    std::vector<Finding> found;
    std::vector<const JointFinding*> of;
    std::vector<std::vector<Suspect>> suspects;
    for (const JointFinding& one : result.found) {
      std::vector<Suspect> near = one.suspects;
      std::erase_if(near, [&](const Suspect& suspect) {
        return is_in(suspect.cause) || s_.sensitivities()[site_of(suspect.effect)].size() == 0;
      });
      if (near.empty()) continue;
      prefer_declared(s_, near);
      std::vector<Suspect> own = near;
      std::erase_if(own, [&](const Suspect& other) { return other.cause != near[0].cause; });
      s_.move_to(choose_cause(s_, own).front());
      s_.move_to(choose_form(s_, s_.last(), found.size()).front());
      s_.fit_again();
      found.emplace_back().p_value = one.p_value;
      of.push_back(&one);
      suspects.push_back(std::move(near));
    }
    for (std::size_t i = 0; i < found.size(); ++i)
      compare(i, *of[i], std::move(suspects[i]), found[i]);
    for (std::size_t i = 0; found.size() > 1 && i < found.size(); ++i) // forms depend on each other
      s_.move_to(choose_form(s_, s_.last(), i).front());
    s_.fit_again();
    drop_unsettled(found);
    for (std::size_t i = 0; i < found.size(); ++i) {
      found[i].rival = up_to(i);
      found[i].between = constant_in_experiments(s_.last().causes[i], s_.candidates);
    }
    s_.findings = std::move(found);
  }

  // Compares the effect `index` with the other causes near it.
  void compare(std::size_t index, const JointFinding& one, std::vector<Suspect> suspects,
               Finding& finding) {
    const Rival all = s_.last();
    const Cause own = all.causes[index];
    std::erase_if(suspects,
                  [&](const Suspect& other) { return other.cause != own && is_in(other.cause); });
    if (std::all_of(suspects.begin(), suspects.end(),
                    [&](const Suspect& other) { return other.cause == own; })) {
      rename_in_folds(one.cause, own);
      return;
    }
    s_.move_to(without_effect(s_.campaign(), all, index));
    std::vector<Rival> rivals = choose_cause(s_, suspects);
    const std::vector<bool> in_set = indistinguishable_rivals(rivals, s_.input.seed);
    for (std::size_t i = 1; i < rivals.size(); ++i) {
      finding.others.push_back(rivals[i]);
      finding.in_set.push_back(in_set[i]);
    }
    const Cause cause = rivals.front().causes.back();
    rename_in_folds(one.cause, cause);
    s_.move_to(cause == own ? all : in_place(rivals.front(), index));
    if (cause != own) s_.move_to(choose_form(s_, s_.last(), index).front());
  }

  // Moves the last effect to position `index`.
  Rival in_place(const Rival& rival, std::size_t index) const {
    std::vector<effects::PlacedEffect> effects = rival.effects;
    std::vector<Cause> causes = rival.causes;
    std::rotate(effects.begin() + static_cast<long>(index), effects.end() - 1, effects.end());
    std::rotate(causes.begin() + static_cast<long>(index), causes.end() - 1, causes.end());
    return fit_rival(s_.campaign(), rival, std::move(effects), std::move(causes), rival.noise,
                     NoiseSearch::again);
  }

  bool is_in(const Cause& cause) const {
    const std::vector<Cause>& in = s_.last().causes;
    return std::find(in.begin(), in.end(), cause) != in.end();
  }

  // Renames a cause in folds that have found the same one, because it would have been replaced
  // there too.
  void rename_in_folds(const Cause& from, const Cause& to) {
    for (CauseFold& fold : s_.folds)
      if (std::find(fold.causes.begin(), fold.causes.end(), to) == fold.causes.end())
        std::replace(fold.causes.begin(), fold.causes.end(), from, to);
  }

  // Whether the predictions converge: an effect of a history of the stress itself may have no
  // consistent stress.
  bool settles(const Rival& rival) const {
    try {
      const models::Model model = s_.model_of(rival);
      calibrate::predict(model, s_.input.training);
      calibrate::predict(model, s_.input.validation);
    } catch (const InputError&) {
      return false;
    }
    return true;
  }

  void drop_unsettled(std::vector<Finding>& found) {
    while (!found.empty() && !settles(s_.last())) {
      std::size_t out = found.size() - 1;
      Rival without = without_effect(s_.campaign(), s_.last(), out);
      for (std::size_t i = 0; i + 1 < found.size() && !settles(without); ++i)
        without = without_effect(s_.campaign(), s_.last(), out = i);
      s_.rejected.push_back(
          fmt::format("{}: significant (p = {:.3g}), but depends on the shear stress, and none "
                      "agrees with it everywhere",
                      cause_name(s_.last().causes[out], s_.candidates), found[out].p_value));
      found.erase(found.begin() + static_cast<long>(out));
      s_.move_to(std::move(without));
    }
  }

  // Returns the law with the effects up to this one.
  Rival up_to(std::size_t index) const {
    const Rival& all = s_.last();
    if (index + 1 == all.effects.size()) return all;
    const auto count = static_cast<long>(index + 1);
    return fit_rival(s_.campaign(), all, {all.effects.begin(), all.effects.begin() + count},
                     {all.causes.begin(), all.causes.begin() + count}, all.noise,
                     NoiseSearch::again);
  }

  Search& s_;
};

} // namespace

std::unique_ptr<Search> search_effects(const TraceInput& input) {
  auto search = std::make_unique<Search>(input);
  Tracer(*search).run();
  return search;
}

} // namespace frictab::trace
