// Markdown tables of the scores.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "core/text.h"
#include "foreign/cases.h"
#include "trace_results.h"

namespace frictab::foreign {

namespace {

using Results = std::vector<Result>;
using Chosen = std::function<bool(const Case&)>;

Results where(const Results& all, const std::string& group, const Chosen& chosen = {}) {
  Results some;
  for (const Result& result : all)
    if (result.score.error.empty() && result.of->group == group && (!chosen || chosen(*result.of)))
      some.push_back(result);
  return some;
}

std::size_t count(const Results& results, const std::function<bool(const Score&)>& what) {
  return static_cast<std::size_t>(std::count_if(
      results.begin(), results.end(), [&](const Result& result) { return what(result.score); }));
}

std::size_t count(const Results& results, bool Score::*what) {
  return count(results, [&](const Score& score) { return score.*what; });
}

double total(const Results& results, const std::function<double(const Score&)>& of) {
  double sum = 0;
  for (const Result& result : results)
    sum += of(result.score);
  return sum;
}

// Pooled over campaigns whose errors may differ in size: each relative to its own noise.
double removed(const Results& results) {
  return total(results, [](const Score& s) { return (s.before - s.after) / s.oracle; }) /
         total(results, [](const Score& s) { return (s.before - s.oracle) / s.oracle; });
}

std::size_t worse(const Results& results) {
  return count(results, [](const Score& s) { return s.worse(); });
}

double wrong_per_case(const Results& results) {
  return total(results, [](const Score& s) { return static_cast<double>(s.wrong); }) /
         static_cast<double>(results.size());
}

void print_effect_row(const std::string& name, const Results& some) {
  fmt::print("| {} | {} | {} | {} | {} | {} | {} | {:.0f} % | {} | {:.2f} |\n", name, some.size(),
             count(some, &Score::delivered), count(some, &Score::right_first),
             count(some, &Score::right_anywhere), count(some, &Score::complete),
             count(some, &Score::in_set), 100 * removed(some), worse(some), wrong_per_case(some));
}

constexpr const char* effect_header =
    "| n | detected | right first | right anywhere | complete | in set | removed | worse | wrong "
    "columns |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";

void print_effects(const Results& all, const std::vector<double>& strengths) {
  if (where(all, "effect").empty()) return;
  fmt::print("\n## One cause, synthetic\n\nCampaigns whose base law takes the effect up are left "
             "out. Where the base law is wrong as well, states named for that count as wrong.\n\n| "
             "strength {}",
             effect_header);
  const auto reached = [&](const Chosen& chosen) {
    Results some = where(all, "effect", chosen);
    std::erase_if(some, [](const Result& r) { return r.score.absorbed; });
    return some;
  };
  for (const double strength : strengths) {
    const auto of = [&](bool wrong_base) {
      return reached([&](const Case& c) {
        return c.options.strength == strength &&
               (c.options.truth == "unlike any law") == wrong_base;
      });
    };
    if (!of(false).empty()) print_effect_row(fmt::format("+{:g} %", 100 * strength), of(false));
    if (!of(true).empty())
      print_effect_row(fmt::format("+{:g} %, base law wrong as well", 100 * strength), of(true));
  }
  fmt::print("\n| by tests, all strengths {}", effect_header);
  for (const std::size_t tests : {12, 20, 24, 40, 81}) {
    const Results some = reached([&](const Case& c) { return c.options.tests == tests; });
    if (!some.empty()) print_effect_row(fmt::format("{} tests", tests), some);
  }
}

std::string found_text(const Score& score) {
  return score.found.empty() ? score.verdict : join(score.found, "; ");
}

// "3/2/1 of 4, 45 %": detected, right column first, complete; share of the removable error removed
std::string cell(const Results& some) {
  if (some.empty()) return "-";
  return fmt::format("{}/{}/{} of {}, {:.0f} %", count(some, &Score::delivered),
                     count(some, &Score::right_first), count(some, &Score::complete), some.size(),
                     100 * removed(some));
}

// One row per effect, one column per strength.
void print_effect_names(const Results& all, const std::vector<double>& strengths) {
  if (where(all, "effect").empty()) return;
  fmt::print("\nDetected/right column first/complete, removed:\n\n| effect |");
  for (const double strength : strengths)
    fmt::print(" +{:g} % |", 100 * strength);
  fmt::print("\n|---|");
  for (std::size_t i = 0; i < strengths.size(); ++i)
    fmt::print("---|");
  fmt::print("\n");
  for (const std::string& name : bench::case_names(all, "effect")) {
    fmt::print("| {} |", name);
    for (const double strength : strengths)
      fmt::print(" {} |", cell(where(all, "effect", [&](const Case& c) {
                   return c.name == name && c.options.strength == strength;
                 })));
    fmt::print("\n");
  }
}

void print_masked(const Results& all) {
  if (where(all, "masked").empty()) return;
  fmt::print("\n## Masked designs, synthetic\n\n| design | n | all named, none false | all named | "
             "a false one | removed | worse |\n|---|--:|--:|--:|--:|--:|--:|\n");
  for (const std::string& name : bench::case_names(all, "masked")) {
    const Results some = where(all, "masked", [&](const Case& c) { return c.name == name; });
    if (some.empty()) continue;
    fmt::print("| {} | {} | {} | {} | {} | {:.0f} % | {} |\n", name, some.size(),
               count(some, [](const Score& s) { return s.complete && s.wrong == 0; }),
               count(some, &Score::complete),
               count(some, [](const Score& s) { return s.wrong > 0; }), 100 * removed(some),
               worse(some));
  }
}

// Wilson's interval of a share, 95 %.
std::string share(std::size_t k, std::size_t n) {
  const double z = 1.96, m = static_cast<double>(n), p = static_cast<double>(k) / m;
  const double middle = (p + z * z / (2 * m)) / (1 + z * z / m);
  const double half = z * std::sqrt(p * (1 - p) / m + z * z / (4 * m * m)) / (1 + z * z / m);
  return fmt::format("{:.1f} % [{:.1f}, {:.1f}]", 100 * p, 100 * std::max(0.0, middle - half),
                     100 * (middle + half));
}

// Of campaigns with several rows per test: one row has no scatter between tests of its own.
std::string scatter_cells(Results some) {
  std::erase_if(some, [](const Result& r) { return r.of->options.rows == "one"; });
  if (some.empty()) return "- | - | -";
  const auto covered = [&](double Score::*truth) {
    return count(some, [&](const Score& s) { return s.scatter_covered(truth); });
  };
  return fmt::format("{} of {} | {} of {} | {:.2f}", covered(&Score::gain_scatter), some.size(),
                     covered(&Score::gain_sample), some.size(),
                     total(some, [](const Score& s) { return s.scatter / s.gain_sample; }) /
                         static_cast<double>(some.size()));
}

void print_null_row(const std::string& name, const Results& some) {
  if (some.empty()) return;
  const std::size_t alarms = count(some, &Score::delivered);
  fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} |\n", name, some.size(), alarms,
             share(alarms, some.size()), count(some, &Score::order_found),
             count(some, &Score::unexplained), worse(some), scatter_cells(some));
}

void print_nulls(const Results& all) {
  if (where(all, "null").empty()) return;
  fmt::print("\n## Nothing missing, synthetic\n\n| nulls | n | false alarms | share | order found "
             "| unexplained | worse | 95 % interval holds the scatter | holds that of these tests "
             "| scatter over that |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  const auto rows_by = [&](auto label, auto items, auto is) {
    for (const auto& item : items)
      print_null_row(fmt::format(fmt::runtime(label), item),
                     where(all, "null", [&](const Case& c) { return is(c.options, item); }));
  };
  using Text = std::string;
  rows_by("noise {}", noise_kinds(), [](const Options& o, const Text& x) { return o.noise == x; });
  rows_by("design {}", design_kinds(),
          [](const Options& o, const Text& x) { return o.design == x; });
  rows_by("{} tests", std::vector<std::size_t>{12, 20, 24, 40, 81},
          [](const Options& o, std::size_t x) { return o.tests == x; });
  rows_by("rows {}", std::vector<Text>{"one", "few", "equal", "many", "unequal", "wild"},
          [](const Options& o, const Text& x) { return o.rows == x; });
  rows_by("law {}", std::vector<Text>{"coulomb", "log_coulomb", "orowan"},
          [](const Options& o, const Text& x) { return o.truth == x; });
  print_null_row("all", where(all, "null"));
}

// Groups in which whatever is delivered is judged by the held-out tests alone.
void print_group(const Results& all, const std::string& group, const std::string& title) {
  if (where(all, group).empty()) return;
  fmt::print("\n## {}, synthetic\n\n| {} | n | a column blamed | delivered | order found | "
             "unexplained | removed | worse |\n|---|--:|--:|--:|--:|--:|--:|--:|\n",
             title, group);
  std::map<std::pair<std::string, double>, Results> rows;
  for (const Result& r : where(all, group))
    rows[{r.of->name, r.of->options.strength}].push_back(r);
  for (const auto& [key, some] : rows)
    fmt::print("| {}{} | {} | {} | {} | {} | {} | {:.0f} % | {} |\n", key.first,
               key.second > 0 ? fmt::format(" +{:g} %", 100 * key.second) : "", some.size(),
               count(some, [](const Score& s) { return !s.found.empty(); }),
               count(some, &Score::delivered), count(some, &Score::order_found),
               count(some, &Score::unexplained), 100 * removed(some), worse(some));
}

void print_look_alikes(const Results& all) {
  if (where(all, "look-alike").empty()) return;
  fmt::print(
      "\n## Look-alikes of measured campaigns, synthetic\n\n| campaign | seed | held-out MAE "
      "before -> after (of the truth), MPa | causes named | wrong | scatter (true) | found "
      "|\n|---|--:|---|--:|--:|---|---|\n");
  for (const Result& r : where(all, "look-alike")) {
    const Score& s = r.score;
    fmt::print("| {} | {} | {:.4g} -> {:.4g} ({:.4g}) | {} of {} | {} | {:.1f} % [{:.1f}, {:.1f}] "
               "({:.0f} %) | {} |\n",
               r.of->name, r.of->options.seed, s.before, s.after, s.oracle, s.causes_named,
               s.causes, s.wrong, 100 * s.scatter, 100 * s.scatter_low, 100 * s.scatter_high,
               100 * s.gain_scatter, found_text(s));
  }
}

void print_invariance(const Results& all) {
  const Results some = where(all, "invariance");
  if (some.empty()) return;
  std::map<std::pair<std::string, std::uint64_t>, const Score*> plain;
  std::vector<std::string> variants;
  for (const Result& r : some) {
    if (r.of->variant == "as it is") plain[{r.of->name, r.of->options.seed}] = &r.score;
    if (std::find(variants.begin(), variants.end(), r.of->variant) == variants.end())
      variants.push_back(r.of->variant);
  }
  fmt::print("\n## What must not change the answer, synthetic\n\n| change | n | verdict or columns "
             "changed | which |\n|---|--:|--:|---|\n");
  for (const std::string& variant : variants) {
    if (variant == "as it is") continue;
    std::size_t n = 0;
    std::vector<std::string> changed;
    for (const Result& r : some) {
      const auto base = plain.find({r.of->name, r.of->options.seed});
      if (r.of->variant != variant || base == plain.end()) continue;
      ++n;
      if (r.score.answer != base->second->answer)
        changed.push_back(
            fmt::format("{}: {} instead of {}", r.of->name, r.score.answer, base->second->answer));
    }
    fmt::print("| {} | {} | {} | {} |\n", variant, n, changed.size(), join(changed, "<br>"));
  }
}

} // namespace

void print_tables(const Results& all, const Counts& counts) {
  print_effects(all, counts.strengths);
  print_effect_names(all, counts.strengths);
  print_masked(all);
  print_nulls(all);
  print_group(all, "misfit", "A base law that is mildly wrong, and nothing else");
  print_group(all, "hidden", "Hidden causes");
  print_group(all, "apart", "Held-out tests of another world");
  print_look_alikes(all);
  print_invariance(all);
  for (const Result& r : all)
    if (!r.score.error.empty())
      fmt::print("\n{} {} {} at {:g}, seed {}: {}\n", r.of->group, r.of->name, r.of->variant,
                 r.of->options.strength, r.of->options.seed, r.score.error);
}

void write_csv(const Results& all, const std::string& file) {
  std::ofstream out(file);
  out << "group,name,variant,strength,seed,kind,design,tests,rows,noise,truth,origin,error,verdict,"
         "found,delivered,right_first,right_anywhere,complete,in_set,causes,causes_named,wrong,p,"
         "before_MPa,after_MPa,truth_MPa,gain_scatter,gain_sample,scatter,scatter_low,scatter_high,"
         "order_found,"
         "absorbed,seconds\n";
  for (const auto& [of, s] : all) {
    const Options& o = of->options;
    out << fmt::format(
        "{},\"{}\",{},{:g},{},{},{},{},{},{},{},synthetic,\"{}\",{},\"{}\",{:d},{:d},"
        "{:d},{:d},{:d},{},{},{},{:g},{:g},{:g},{:g},{:g},{:g},{:g},{:g},{:g},{:d},{:d},"
        "{:.2f}\n",
        of->group, of->name, of->variant, o.strength, o.seed, o.kind, o.design, o.tests, o.rows,
        o.noise, o.truth, s.error, s.verdict, join(s.found, "; "), s.delivered, s.right_first,
        s.right_anywhere, s.complete, s.in_set, s.causes, s.causes_named, s.wrong, s.p_value,
        s.before, s.after, s.oracle, s.gain_scatter, s.gain_sample, s.scatter, s.scatter_low,
        s.scatter_high, s.order_found, s.absorbed, s.seconds);
  }
}

} // namespace frictab::foreign
