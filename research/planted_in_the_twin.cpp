// What tracing finds in synthetic campaigns whose truth is known: planted effects, hidden causes,
// nothing at all. Prints markdown tables; research/results/tracing_twin.csv comes from here.
//
// usage: frictab_bench_trace [--nulls N] [--seeds N] [--strengths A,B] [--only TEXT] [--alpha A]
//                            [--threads N] [--first-seed N] [--list]
// Seconds are wall times of tracing alone; with --threads 1 nothing else runs beside it.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "calibrate/calibration.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "data/derived.h"
#include "trace/trace.h"
#include "trace_results.h"
#include "twin/twin.h"

namespace frictab {

using trace::Trace;
using trace::TracedEffect;
using twin::EffectSpec;
using twin::TwinPart;

namespace {

// The stage under test.
Trace traced(const trace::TraceInput& input) {
  return trace::trace(input);
}

// --- cases --------------------------------------------------------------------------------------

struct Planted {
  const char* name;
  std::vector<const char*> effects; // without their strength
  const char* law = "log_coulomb";
  const char* hide = ""; // a column that the data lack
};

// One per form of `frictab list effects` (but the spline, which is no form of a cause) and per
// derived quantity that does not follow the order of tests; in states, bystanders and beside a
// decoy; on mu, on the limit and added.
const std::vector<Planted>& single_effects() {
  static const std::vector<Planted> all = {
      {"power humidity", {"form=power,column=humidity_pct"}},
      {"exponential T_tool", {"form=exponential,column=T_tool_C"}},
      {"linear roughness", {"form=linear,column=Ra_um"}},
      {"logarithmic film, decoy", {"form=logarithmic,column=film_um"}},
      {"hinge film, decoy", {"form=hinge,column=film_um"}},
      {"arrhenius T_contact", {"form=arrhenius,column=T_contact_C"}, "orowan"},
      {"saturation s", {"form=saturation,column=s_mm"}},
      {"hinge psi", {"form=hinge,column=psi"}},
      {"step T_contact", {"form=step,column=T_contact_C"}},
      {"bump T_contact", {"form=bump,column=T_contact_C"}},
      {"stribeck v", {"form=stribeck,column=v_rel_mm_s"}},
      {"periodic s", {"form=periodic,column=s_mm"}},
      {"category direction", {"form=category,column=direction"}},
      {"category tool", {"form=category,column=tool"}},
      {"product s T_contact", {"form=product,column=s_mm,column2=T_contact_C"}},
      {"product dwell_s s", {"form=product,column=dwell_s,column2=s_mm"}},
      {"power dwell_s", {"form=power,column=dwell_s"}},
      {"linear vibration", {"form=linear,column=vib"}},
      {"step humidity", {"form=step,column=humidity_pct"}},
      {"linear sliding_distance", {"form=linear,column=sliding_distance"}},
      {"saturation friction_work", {"form=saturation,column=friction_work"}},
      {"saturation energy", {"form=saturation,column=energy"}},
      {"linear friction_power", {"form=linear,column=friction_power"}},
      {"saturation time", {"form=saturation,column=time_since_start"}},
      {"logarithmic dwell", {"form=logarithmic,column=dwell"}},
      {"linear peak_sigma_n", {"form=linear,column=peak_sigma_n"}},
      {"linear mean_sigma_n", {"form=linear,column=mean_sigma_n"}},
      {"hinge peak_v_rel", {"form=hinge,column=peak_v_rel"}},
      {"bump mean_v_rel", {"form=bump,column=mean_v_rel"}},
      {"exponential peak_T_contact", {"form=exponential,column=peak_T_contact"}, "orowan"},
      {"hinge mean_T_contact", {"form=hinge,column=mean_T_contact"}},
      {"linear T_tool on m", {"form=linear,column=T_tool_C,on=m"}, "orowan"},
      {"category direction on m", {"form=category,column=direction,on=m"}, "shaw"},
      {"saturation s on m", {"form=saturation,column=s_mm,on=m,sign=-"}, "orowan"},
      {"hinge v on tau", {"form=hinge,column=v_rel_mm_s,on=tau"}},
      {"saturation s on tau", {"form=saturation,column=s_mm,on=tau,sign=-"}},
      {"linear film on tau", {"form=linear,column=film_um,on=tau"}, "wzl"},
  };
  return all;
}

// Recorded, but not to be told from a drift over the order of tests.
const std::vector<Planted>& order_effects() {
  static const std::vector<Planted> all = {
      {"power test_order", {"form=power,column=test_order"}},
      {"linear lab_T", {"form=linear,column=lab_T_C"}},
      {"category batch", {"form=category,column=batch"}},
  };
  return all;
}

const std::vector<Planted>& hidden_effects() {
  static const std::vector<Planted> all = {
      {"groups", {"form=linear,column=latent,latent=groups"}},
      {"batch", {"form=linear,column=latent,latent=batch"}},
      {"drift", {"form=linear,column=latent,latent=drift"}},
      {"order", {"form=linear,column=latent,latent=order"}},
      {"random", {"form=linear,column=latent,latent=random"}},
      {"order added", {"form=linear,column=latent,latent=order,on=tau"}},
      {"batch on m", {"form=linear,column=latent,latent=batch,on=m"}, "orowan"},
      {"drift of wzl", {"form=linear,column=latent,latent=drift"}, "wzl"},
      {"direction hidden", {"form=category,column=direction"}, "log_coulomb", "direction"},
      {"dwell_s hidden", {"form=power,column=dwell_s"}, "log_coulomb", "dwell_s"},
  };
  return all;
}

const std::vector<Planted>& pairs_of_effects() {
  static const std::vector<Planted> all = {
      {"run-in and direction", {"form=saturation,column=s_mm", "form=category,column=direction"}},
      {"humidity and speed", {"form=linear,column=humidity_pct", "form=hinge,column=v_rel_mm_s"}},
      {"dwell_s, and T_tool on m",
       {"form=power,column=dwell_s", "form=linear,column=T_tool_C,on=m"},
       "orowan"},
      {"film and temperature", {"form=logarithmic,column=film_um", "form=bump,column=T_contact_C"}},
      {"work and roughness", {"form=saturation,column=friction_work", "form=linear,column=Ra_um"}},
      {"speed, and run-in added",
       {"form=stribeck,column=v_rel_mm_s", "form=saturation,column=s_mm,on=tau,sign=-"}},
  };
  return all;
}

constexpr const char* null_laws[] = {"log_coulomb", "coulomb",     "orowan",
                                     "shaw",        "exp_coulomb", "wzl"};
constexpr const char* noises[] = {"normal", "t4", "heteroscedastic"};

struct Case {
  std::string group; // single | order | hidden | two | null
  std::string name;
  double strength = 0;
  twin::TwinOptions options;
};

twin::TwinOptions campaign(const std::string& law, std::uint64_t seed, const std::string& noise) {
  twin::TwinOptions options;
  options.law = law;
  options.seed = seed;
  options.noise = noise;
  options.profile = "varied";
  options.more_bystanders = true;
  options.design = twin::parse_design("p=500,1625,2750", {});
  options.scatter = twin::parse_scatter("test=0.04,slow=0.04,rho=0.95,white=0.015");
  return options;
}

Case case_of(const std::string& group, const Planted& planted, double strength,
             std::uint64_t seed) {
  Case made{group, planted.name, strength, campaign(planted.law, seed, "normal")};
  for (const char* effect : planted.effects)
    made.options.effects.push_back(
        twin::parse_effect(fmt::format("{},strength={}", effect, shortest(strength))));
  if (*planted.hide) made.options.hide = {planted.hide};
  return made;
}

struct Options {
  std::size_t nulls = 36;
  std::size_t seeds = 1;
  std::uint64_t first_seed = 1;
  std::vector<double> strengths = {0.02, 0.05, 0.15, 0.5};
  std::string only;
  double alpha = trace::TraceOptions{}.alpha;
  unsigned threads = 0;
  bool list = false;
};

std::vector<Case> all_cases(const Options& options) {
  const std::pair<const char*, const std::vector<Planted>&> groups[] = {
      {"single", single_effects()},
      {"order", order_effects()},
      {"hidden", hidden_effects()},
      {"two", pairs_of_effects()}};
  std::vector<Case> cases;
  for (const auto& [group, effects] : groups)
    for (const Planted& planted : effects)
      for (const double strength : options.strengths)
        for (std::size_t s = 0; s < options.seeds; ++s)
          cases.push_back(case_of(group, planted, strength, options.first_seed + s));
  for (std::size_t i = 0; i < options.nulls; ++i) {
    const char* law = null_laws[i % std::size(null_laws)];
    const char* noise = noises[i / std::size(null_laws) % std::size(noises)];
    cases.push_back({"null", fmt::format("null {} {}", law, noise), 0,
                     campaign(law, 1000 * options.first_seed + i, noise)});
  }
  std::erase_if(cases, [&](const Case& c) {
    return (c.group + " " + c.name).find(options.only) == std::string::npos;
  });
  return cases;
}

// --- what is the same column ------------------------------------------------------------------

// Columns and derived quantities of a campaign by name; sliding_distance is s_mm, peak_v_rel is
// v_rel_mm_s: whoever names the one has found the other.
class Quantities {
public:
  explicit Quantities(const TwinPart& part) : part_(part) {}

  bool same(const std::string& a, const std::string& b) const {
    if (a == b) return true;
    const auto x = values(a), y = values(b);
    return bench::go_together(x, y, 1 - 1e-6);
  }

  // As sets, in any order.
  bool same(const std::vector<std::string>& a, const std::vector<std::string>& b) const {
    if (a.size() != b.size()) return false;
    if (a.size() == 1) return same(a[0], b[0]);
    return (same(a[0], b[0]) && same(a[1], b[1])) || (same(a[0], b[1]) && same(a[1], b[0]));
  }

private:
  std::vector<double> values(const std::string& name) const {
    if (const data::Column* column = part_.data.find(name))
      return column->levels.empty() ? column->values : std::vector<double>{};
    const data::DerivedQuantity* quantity = data::find_derived(name);
    if (quantity == nullptr) return {};
    for (const std::string& need : quantity->needs)
      if (need != "tau" && !part_.data.has(need)) return {};
    return data::derive(*quantity, part_.data, part_.base_MPa);
  }

  const TwinPart& part_;
};

using Names = std::vector<std::string>; // one column, or the two of a product

Names names_of(const EffectSpec& spec) {
  return spec.column2.empty() ? Names{spec.column} : Names{spec.column, spec.column2};
}

Names names_of(const TracedEffect& effect) {
  Names names;
  for (const effects::EffectInput& input : effect.placed.inputs)
    names.push_back(input.column);
  return names;
}

// Of a product with a derived factor the recorded columns behind it, which match nothing planted.
Names names_of(const trace::Alternative& alternative) {
  const bool product = alternative.form == "product";
  return alternative.derived.empty() || product ? alternative.columns : Names{alternative.derived};
}

// --- score --------------------------------------------------------------------------------------

struct Score {
  std::string error;          // the case could not be made or traced
  std::size_t planted = 0;    // that could be named
  std::size_t added = 0;      // effects that tracing added
  std::size_t named = 0;      // planted ones among them
  std::size_t in_sets = 0;    // planted ones in the set of an added one
  std::size_t wrong = 0;      // added ones that were not planted
  std::size_t order_only = 0; // added ones that tracing itself calls confounded with the order
  double sets = 0;            // columns in the sets of all added ones
  bool detected = false, first = false, place = false, form = false, family = false;
  bool order = false; // structure along the order of tests, or no column explains it
  double before = 0, after = 0, oracle = 0; // validation MAE, MPa
  double floor_ratio = 0;                   // estimated noise floor over the true one
  double scatter = 0;
  bool excess = false; // more than a given repeatability of what the twin scatters by
  double seconds = 0;
  double p_value = 1;   // of the first effect, or of what is left where there is none
  double order_p = 1;   // of no structure along the order of tests
  std::string found;    // "saturation of s_mm on mu"
  std::string rejected; // what was turned down or only led, and why
};

// Forms that a few levels cannot tell apart.
std::string family_of(const std::string& form) {
  static const std::map<std::string, std::string> families = {
      {"power", "monotone"},       {"exponential", "monotone"}, {"linear", "monotone"},
      {"logarithmic", "monotone"}, {"arrhenius", "monotone"},   {"saturation", "monotone"},
      {"hinge", "threshold"},      {"step", "threshold"},       {"bump", "peak"},
      {"stribeck", "peak"}};
  const auto family = families.find(form);
  return family == families.end() ? form : family->second;
}

class Judge {
public:
  Judge(const twin::Twin& twin, const Trace& trace)
      : twin_(twin), trace_(trace), quantities_(twin.training) {}

  Score score() {
    score_.detected = trace_.verdict == trace::Verdict::effect_added;
    score_.order = trace_.order.found || trace_.verdict == trace::Verdict::unexplained_structure;
    score_.added = trace_.effects.size();
    for (const EffectSpec& spec : twin_.options.effects)
      if (recorded(spec)) judge_planted(spec);
    for (const TracedEffect& effect : trace_.effects)
      judge_added(effect);
    score_.p_value =
        trace_.effects.empty() ? trace_.remaining.p_value : trace_.effects.front().p_value;
    score_.order_p = trace_.order.p_value;
    score_.rejected = bench::turned_down(trace_);
    errors();
    return std::move(score_);
  }

private:
  bool recorded(const EffectSpec& spec) const {
    const auto& hidden = twin_.options.hide;
    return spec.column != "latent" &&
           std::find(hidden.begin(), hidden.end(), spec.column) == hidden.end();
  }

  void judge_planted(const EffectSpec& spec) {
    ++score_.planted;
    const Names names = names_of(spec);
    bool named = false, in_set = false;
    for (const TracedEffect& effect : trace_.effects) {
      const bool here = quantities_.same(names_of(effect), names);
      if (here && !named) judge_match(spec, effect);
      named = named || here;
      for (const trace::Alternative& other : effect.alternatives)
        in_set = in_set || (other.in_set && quantities_.same(names_of(other), names));
    }
    score_.named += named;
    score_.in_sets += named || in_set;
  }

  // Of the first effect planted; `first` also where it is any planted one that was found first.
  void judge_match(const EffectSpec& spec, const TracedEffect& effect) {
    score_.first = score_.first || &effect == &trace_.effects.front();
    if (score_.planted > 1) return;
    score_.place = effect.placed.acts_on == spec.on;
    score_.form = effect.placed.form->name == spec.form;
    score_.family = family_of(effect.placed.form->name) == family_of(spec.form);
  }

  void judge_added(const TracedEffect& effect) {
    const auto& specs = twin_.options.effects;
    const Names names = names_of(effect);
    score_.wrong += std::none_of(specs.begin(), specs.end(), [&](const EffectSpec& spec) {
      return recorded(spec) && quantities_.same(names_of(spec), names);
    });
    score_.order_only += effect.order_confounded;
    std::set<Names> set{names};
    for (const trace::Alternative& other : effect.alternatives)
      if (other.in_set) set.insert(names_of(other));
    score_.sets += static_cast<double>(set.size());
    score_.found +=
        fmt::format("{}{} of {} on {}", score_.found.empty() ? "" : "; ", effect.placed.form->name,
                    join(names, " x "), effects::acts_on_name(effect.placed.acts_on));
  }

  static double mae(const TwinPart& part) {
    const auto tau = part.data.values("tau_R_MPa");
    double sum = 0;
    for (std::size_t i = 0; i < tau.size(); ++i)
      sum += std::abs(tau[i] - part.oracle_MPa[i]);
    return sum / static_cast<double>(tau.size());
  }

  void errors() {
    score_.before = trace_.before.validation.mae_MPa;
    score_.after = score_.detected ? trace_.after.validation.mae_MPa : score_.before;
    score_.oracle = mae(twin_.validation);
    const bool unseen = trace_.noise_floor.part == "validation";
    score_.floor_ratio =
        trace_.noise_floor.mae_MPa / (unseen ? score_.oracle : mae(twin_.training));
    score_.scatter = trace_.scatter_between;
    score_.excess = trace_.scatter_at_least > twin_.options.scatter.test;
  }

  const twin::Twin& twin_;
  const Trace& trace_;
  Quantities quantities_;
  Score score_;
};

Score run_case(const Case& c, double alpha) try {
  twin::Twin twin = twin::make_twin(c.options);
  for (TwinPart* part : {&twin.training, &twin.validation})
    data::fingerprint(part->data);
  calibrate::CalibrationInput input{twin.training.data, twin.validation.data, {}, {}};
  input.models.use = {c.options.law};
  const calibrate::Calibration calibration = calibrate::calibrate(input);
  trace::TraceOptions options;
  options.alpha = alpha;
  const auto begin = std::chrono::steady_clock::now();
  const Trace trace = traced({twin.training.data, twin.validation.data, calibration.fits.front(),
                              options, input.options.bootstrap, c.options.seed});
  const auto end = std::chrono::steady_clock::now();
  Score score = Judge(twin, trace).score();
  score.seconds = std::chrono::duration<double>(end - begin).count();
  return score;
} catch (const std::exception& error) {
  Score failed;
  failed.error = error.what();
  return failed;
}

// --- tables -------------------------------------------------------------------------------------

struct Result {
  const Case* of;
  Score score;
};
using Results = std::vector<Result>;

Results where(const Results& all, const std::function<bool(const Case&)>& chosen) {
  Results some;
  for (const Result& result : all)
    if (result.score.error.empty() && chosen(*result.of)) some.push_back(result);
  return some;
}

double mean(const Results& results, const std::function<double(const Score&)>& of) {
  double sum = 0;
  for (const Result& result : results)
    sum += of(result.score);
  return results.empty() ? std::nan("") : sum / static_cast<double>(results.size());
}

std::string share(const Results& results, bool Score::*what) {
  return fmt::format("{:.2f}", mean(results, [&](const Score& s) { return s.*what ? 1.0 : 0.0; }));
}

// Of the results in which the planted column was named.
std::string share_of_named(const Results& results, bool Score::*what) {
  Results named;
  for (const Result& result : results)
    if (result.score.named > 0) named.push_back(result);
  return share(named, what);
}

double total(const Results& results, const std::function<double(const Score&)>& of) {
  return results.empty() ? 0 : mean(results, of) * static_cast<double>(results.size());
}

// Pooled: what was gained over what could be gained, on experiments not trained on.
double removed(const Results& results) {
  return total(results, [](const Score& s) { return s.before - s.after; }) /
         total(results, [](const Score& s) { return s.before - s.oracle; });
}

double per(const Results& results, std::size_t Score::*what, std::size_t Score::*of) {
  const auto sum = [&](std::size_t Score::*member) {
    return total(results, [&](const Score& s) { return static_cast<double>(s.*member); });
  };
  return sum(what) / sum(of);
}

double set_size(const Results& results) {
  return total(results, [](const Score& s) { return s.sets; }) /
         total(results, [](const Score& s) { return static_cast<double>(s.added); });
}

double average(const Results& results, std::size_t Score::*what) {
  return mean(results, [&](const Score& s) { return static_cast<double>(s.*what); });
}

double average(const Results& results, double Score::*what) {
  return mean(results, [&](const Score& s) { return s.*what; });
}

double slowest(const Results& results) {
  double most = 0;
  for (const Result& result : results)
    most = std::max(most, result.score.seconds);
  return most;
}

Results of_group(const Results& all, const std::string& group, double strength) {
  return where(all, [&](const Case& c) { return c.group == group && c.strength == strength; });
}

void print_single(const Results& all, const std::vector<double>& strengths) {
  fmt::print("\n## One planted effect\n\n| strength | n | detected | right column first | in set "
             "| columns in set | place | form | family | removed | wrong columns | floor | s mean "
             "| s max |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const double strength : strengths) {
    const Results some = of_group(all, "single", strength);
    if (some.empty()) continue;
    fmt::print("| +{:g} % | {} | {} | {} | {:.2f} | {:.2f} | {} | {} | {} | {:.2f} | {:.2f} | "
               "{:.3f} | {:.1f} | {:.1f} |\n",
               100 * strength, some.size(), share(some, &Score::detected),
               share(some, &Score::first), per(some, &Score::in_sets, &Score::planted),
               set_size(some), share_of_named(some, &Score::place),
               share_of_named(some, &Score::form), share_of_named(some, &Score::family),
               removed(some), average(some, &Score::wrong), average(some, &Score::floor_ratio),
               average(some, &Score::seconds), slowest(some));
  }
}

void print_two(const Results& all, const std::vector<double>& strengths) {
  fmt::print("\n## Two planted effects\n\n| strength each | n | named | in sets | precision | all "
             "named | removed | s mean |\n|---|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const double strength : strengths) {
    const Results some = of_group(all, "two", strength);
    if (some.empty()) continue;
    fmt::print("| +{:g} % | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} |\n",
               100 * strength, some.size(), per(some, &Score::named, &Score::planted),
               per(some, &Score::in_sets, &Score::planted),
               1 - per(some, &Score::wrong, &Score::added),
               mean(some, [](const Score& s) { return s.named == s.planted ? 1.0 : 0.0; }),
               removed(some), average(some, &Score::seconds));
  }
}

// "2/2/2 of 2; 5.31 -> 4.97 (4.95); saturation of s_mm on mu"
std::string cell(const Results& results) {
  if (results.empty()) return "-";
  std::set<std::string> found;
  for (const Result& result : results)
    if (!result.score.found.empty()) found.insert(result.score.found);
  const auto count = [&](auto what) {
    return static_cast<std::size_t>(std::lround(total(results, what)));
  };
  return fmt::format("{}/{}/{} of {}; {:.2f} -> {:.2f} ({:.2f}); {}",
                     count([](const Score& s) { return s.detected ? 1.0 : 0.0; }),
                     count([](const Score& s) { return s.named == s.planted ? 1.0 : 0.0; }),
                     count([](const Score& s) { return s.in_sets == s.planted ? 1.0 : 0.0; }),
                     results.size(), average(results, &Score::before),
                     average(results, &Score::after), average(results, &Score::oracle),
                     join(std::vector<std::string>(found.begin(), found.end()), " \\| "));
}

// One row per case, one column per strength.
void print_rows(const Results& all, const std::string& group, const std::vector<double>& strengths,
                const std::function<std::string(const Results&)>& text) {
  if (bench::case_names(all, group).empty()) return;
  fmt::print("\n| {} |", group);
  for (const double strength : strengths)
    fmt::print(" +{:g} % |", 100 * strength);
  fmt::print("\n|---|");
  for (std::size_t i = 0; i < strengths.size(); ++i)
    fmt::print("---|");
  fmt::print("\n");
  for (const std::string& name : bench::case_names(all, group)) {
    fmt::print("| {} |", name);
    for (const double strength : strengths)
      fmt::print(" {} |", text(where(all, [&](const Case& c) {
                   return c.group == group && c.name == name && c.strength == strength;
                 })));
    fmt::print("\n");
  }
}

std::string hidden_cell(const Results& results) {
  if (results.empty()) return "-";
  return fmt::format("order {:.2f}; blamed on columns {:.2f}, of which confounded {:.2f}; scatter "
                     "{:.1f} %, beyond the repeatability {:.2f}",
                     mean(results, [](const Score& s) { return s.order ? 1.0 : 0.0; }),
                     average(results, &Score::wrong), average(results, &Score::order_only),
                     100 * average(results, &Score::scatter),
                     mean(results, [](const Score& s) { return s.excess ? 1.0 : 0.0; }));
}

std::string order_cell(const Results& results) {
  if (results.empty()) return "-";
  return fmt::format("order {:.2f}, named {:.2f}; {}",
                     mean(results, [](const Score& s) { return s.order ? 1.0 : 0.0; }),
                     average(results, &Score::named), cell(results));
}

// Laws and kinds of noise of the nulls, each alone and all together.
void print_null_row(const Results& some, const std::string& name) {
  if (some.empty()) return;
  fmt::print(
      "| {} | {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.1f} % | {:.3f} | {:.1f} | {:.1f} |\n",
      name, some.size(), mean(some, [](const Score& s) { return s.detected ? 1.0 : 0.0; }),
      mean(some, [](const Score& s) { return s.detected && s.p_value <= 0.02 ? 1.0 : 0.0; }),
      mean(some, [](const Score& s) { return s.order ? 1.0 : 0.0; }),
      average(some, &Score::floor_ratio), 100 * average(some, &Score::scatter),
      mean(some, [](const Score& s) { return s.excess ? 1.0 : 0.0; }),
      average(some, &Score::seconds), slowest(some));
}

void print_nulls(const Results& all) {
  const auto nulls = [&](const std::string& law, const std::string& noise) {
    return where(all, [&](const Case& c) {
      return c.group == "null" && (law.empty() || c.options.law == law) &&
             (noise.empty() || c.options.noise == noise);
    });
  };
  if (nulls("", "").empty()) return;
  fmt::print(
      "\n## Nothing missing\n\n| nulls | n | false alarms | with p <= 0.02 | order flagged | "
      "floor | scatter | beyond the repeatability | s mean | s max |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const char* noise : noises)
    print_null_row(nulls("", noise), noise);
  for (const char* law : null_laws)
    print_null_row(nulls(law, ""), law);
  print_null_row(nulls("", ""), "all");
}

void print_errors(const Results& all) {
  for (const Result& result : all)
    if (!result.score.error.empty())
      fmt::print("\n{} {} at {:g}, seed {}: {}\n", result.of->group, result.of->name,
                 result.of->strength, result.of->options.seed, result.score.error);
}

void print_tables(const Results& all, const std::vector<double>& strengths) {
  const auto has = [&](const char* group) { return !bench::case_names(all, group).empty(); };
  if (has("single")) print_single(all, strengths);
  if (has("single"))
    fmt::print("\ndetected/named/in set; validation MAE before -> after (oracle), MPa; what was "
               "found\n");
  print_rows(all, "single", strengths, cell);
  if (has("two")) print_two(all, strengths);
  print_rows(all, "two", strengths, cell);
  if (has("order")) fmt::print("\n## Causes along the order of tests\n");
  print_rows(all, "order", strengths, order_cell);
  if (has("hidden")) fmt::print("\n## Hidden causes\n");
  print_rows(all, "hidden", strengths, hidden_cell);
  print_nulls(all);
  print_errors(all);
}

void declare(CLI::App& app, Options& options) {
  app.add_option("--nulls", options.nulls, "campaigns in which nothing is missing");
  app.add_option("--seeds", options.seeds, "seeds per effect and strength");
  app.add_option("--first-seed", options.first_seed, "the first of them");
  app.add_option("--strengths", options.strengths, "of planted effects")->delimiter(',');
  app.add_option("--only", options.only, "cases whose group and name contain this");
  app.add_option("--alpha", options.alpha, "family-wise error");
  app.add_option("--threads", options.threads, "0: all cores");
  app.add_flag("--list", options.list, "name the cases, run nothing");
}

void print_list(const std::vector<Case>& cases) {
  for (const Case& c : cases)
    fmt::print("{} | {} | {:g} | {} | {} | seed {}\n", c.group, c.name, c.strength, c.options.law,
               c.options.noise, c.options.seed);
}

Results run_all(const std::vector<Case>& cases, double alpha) {
  Results results(cases.size());
  parallel_for(cases.size(), [&](std::size_t i) {
    results[i] = {&cases[i], run_case(cases[i], alpha)};
    const Score& score = results[i].score;
    fmt::print(stderr, "{} {} {:g} seed {}: {} p {:.3f}{}, order {:.3f} | {}\n", cases[i].group,
               cases[i].name, cases[i].strength, cases[i].options.seed,
               score.error.empty() ? score.found : score.error, score.p_value,
               score.order ? " along the order" : "", score.order_p, score.rejected);
  });
  return results;
}

} // namespace
} // namespace frictab

int main(int argc, char** argv) try {
  using namespace frictab;
  Options options;
  CLI::App app("Scores residual tracing on synthetic campaigns");
  declare(app, options);
  CLI11_PARSE(app, argc, argv);
  set_threads(options.threads);
  const auto cases = all_cases(options);
  if (options.list)
    print_list(cases);
  else
    print_tables(run_all(cases, options.alpha), options.strengths);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
