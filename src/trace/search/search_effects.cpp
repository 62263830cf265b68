// All terms at once; then structure along the order of tests.
#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "trace/search/choose_effect.h"
#include "trace/search/joint.h"
#include "trace/search/order_search.h"

namespace frictab::trace {

namespace {

// Builds up what is found from the terms of the joint search.
class Adder {
public:
  Adder(const Search& search, JointResult result) : f_{search} {
    f_.leftover = std::move(result.leftover);
    f_.pays = result.pays;
    f_.folds = std::move(result.folds);
    for (const JointFinding& finding : result.dropped)
      reject(finding.cause, finding.p_value,
             "predicts tests that are left out no better together with the others");
    for (const JointFinding& finding : result.unsure)
      reject(finding.cause, finding.p_value,
             "few tests, which scatter more than the others, carry it");
    if (!result.found.empty()) add(result.found);
    for (const JointFinding& one : result.without_walk)
      if (!is_in(one.cause)) note_confounded(one);
  }

  Found result() && { return std::move(f_); }

private:
  void reject(const Cause& cause, double p_value, const char* why) {
    f_.rejected.push_back(rejection(law().candidates(), cause, p_value, why));
  }

  const Search& law() const { return f_.search; }
  void move_to(Rival rival) { f_.search = law().at(std::move(rival)); }

  // Notes the first of its causes that is constant within tests: it would have been found if
  // nothing followed the order of tests.
  void note_confounded(const JointFinding& finding) {
    const auto first = std::ranges::find_if(finding.suspects, [&](const Suspect& one) {
      return constant_in_experiments(one.cause, law().candidates());
    });
    if (first != finding.suspects.end()) f_.confounded.push_back({first->cause, finding.p_value});
  }

  // Adds all findings with the causes that the search names; then compares each with those near it.
  void add(const std::vector<JointFinding>& all) {
    std::vector<Finding>& found = f_.findings;
    std::vector<const JointFinding*> of;
    std::vector<std::vector<Suspect>> suspects;
    for (const JointFinding& one : all) {
      std::vector<Suspect> near = one.suspects;
      std::erase_if(near, [&](const Suspect& suspect) {
        return is_in(suspect.cause) || law().sensitivities()[site_of(suspect.effect)].size() == 0;
      });
      if (near.empty()) continue;
      near = prefer_declared(law(), std::move(near));
      std::vector<Suspect> own = near;
      std::erase_if(own, [&](const Suspect& other) { return other.cause != near[0].cause; });
      move_to(choose_cause(law(), own).front());
      move_to(choose_form(law(), law().last(), found.size()).front());
      f_.search = law().fitted_again();
      found.emplace_back().p_value = one.p_value;
      of.push_back(&one);
      suspects.push_back(std::move(near));
    }
    for (std::size_t i = 0; i < found.size(); ++i)
      compare(i, *of[i], std::move(suspects[i]), found[i]);
    for (std::size_t i = 0; found.size() > 1 && i < found.size(); ++i) // forms depend on each other
      move_to(choose_form(law(), law().last(), i).front());
    f_.search = law().fitted_again();
    drop_unsettled(found);
    for (std::size_t i = 0; i < found.size(); ++i) {
      found[i].rival = up_to(i);
      found[i].between = constant_in_experiments(law().last().causes[i], law().candidates());
    }
  }

  // Compares the effect `index` with the other causes near it.
  void compare(std::size_t index, const JointFinding& one, std::vector<Suspect> suspects,
               Finding& finding) {
    const Rival all = law().last();
    const Cause own = all.causes[index];
    // A product with a column says more than the column: it is found by itself, or not at all.
    std::erase_if(suspects, [&](const Suspect& other) {
      return other.cause != own && (is_in(other.cause) || other.cause.is_product_with(own));
    });
    if (std::ranges::all_of(suspects, [&](const Suspect& other) { return other.cause == own; })) {
      rename_in_folds(one.cause, own);
      return;
    }
    move_to(without_effect(law().campaign(), all, index));
    std::vector<Rival> rivals = choose_cause(law(), suspects);
    const std::vector<bool> in_set = indistinguishable_rivals(rivals, law().input().seed);
    for (std::size_t i = 1; i < rivals.size(); ++i) {
      finding.others.push_back(rivals[i]);
      finding.in_set.push_back(in_set[i]);
    }
    const Cause cause = rivals.front().causes.back();
    rename_in_folds(one.cause, cause);
    move_to(cause == own ? all : in_place(rivals.front(), index));
    if (cause != own) move_to(choose_form(law(), law().last(), index).front());
  }

  // Moves the last effect to position `index`.
  Rival in_place(const Rival& rival, std::size_t index) const {
    std::vector<effects::PlacedEffect> effects = rival.effects;
    std::vector<Cause> causes = rival.causes;
    std::rotate(effects.begin() + index, effects.end() - 1, effects.end());
    std::rotate(causes.begin() + index, causes.end() - 1, causes.end());
    return fit_rival(law().campaign(), rival, std::move(effects), std::move(causes), rival.noise,
                     NoiseSearch::again);
  }

  bool is_in(const Cause& cause) const { return contains(law().last().causes, cause); }

  // Renames a cause in folds that have found the same one, because it would have been replaced
  // there too.
  void rename_in_folds(const Cause& from, const Cause& to) {
    for (CauseFold& fold : f_.folds)
      if (!contains(fold.causes, to)) std::ranges::replace(fold.causes, from, to);
  }

  // Whether the predictions converge: an effect of a history of the stress itself may have no
  // consistent stress.
  bool settles(const Rival& rival) const {
    try {
      const models::Model model = law().model_of(rival);
      calibrate::predict(model, law().input().training);
      calibrate::predict(model, law().input().validation);
    } catch (const InputError&) {
      return false;
    }
    return true;
  }

  void drop_unsettled(std::vector<Finding>& found) {
    while (!found.empty() && !settles(law().last())) {
      std::size_t out = found.size() - 1;
      Rival without = without_effect(law().campaign(), law().last(), out);
      for (std::size_t i = 0; i + 1 < found.size() && !settles(without); ++i)
        without = without_effect(law().campaign(), law().last(), out = i);
      reject(law().last().causes[out], found[out].p_value,
             "depends on the shear stress, and none agrees with it everywhere");
      found.erase(found.begin() + out);
      move_to(std::move(without));
    }
  }

  // Returns the law with the effects up to this one.
  Rival up_to(std::size_t index) const {
    const Rival& all = law().last();
    if (index + 1 == all.effects.size()) return all;
    const auto count = static_cast<long>(index + 1);
    return fit_rival(law().campaign(), all, {all.effects.begin(), all.effects.begin() + count},
                     {all.causes.begin(), all.causes.begin() + count}, all.noise,
                     NoiseSearch::again);
  }

  Found f_;
};

} // namespace

std::string rejection(const Candidates& candidates, const Cause& cause, double p_value,
                      std::string_view why) {
  return fmt::format("{}: significant (p = {:.3g}), but {}", cause_name(cause, candidates), p_value,
                     why);
}

Found search_effects(const TraceInput& input, std::span<const Cause> barred) {
  Found found{Search(input)};
  if (!found.search.negligible())
    found = Adder(found.search, find_jointly(found.search, barred)).result();
  return without_drift(std::move(found));
}

} // namespace frictab::trace
