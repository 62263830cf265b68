// What tracing finds in synthetic campaigns that do not resemble the twin (campaigns.h):
// planted causes, masked designs, nothing at all, hidden causes, look-alikes of measured campaigns.
// Prints markdown tables.
//
// usage: frictab_bench_foreign [--only TEXT] [--seeds N] [--first-seed N] [--nulls N]
//                              [--masked-seeds N] [--strengths A,B] [--factors A,B] [--alpha A]
//                              [--search-only] [--no-validation] [--show] [--threads N]
//                              [--csv FILE] [--list]
#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/parallel.h"
#include "core/text.h"
#include "foreign/cases.h"
#include "job/job.h"

namespace frictab::foreign {
namespace {

struct Arguments {
  Counts counts;
  double alpha = trace::TraceOptions{}.alpha;
  unsigned threads = 0;
  std::string csv;
  bool list = false, show = false, search_only = false, no_validation = false;
};

void declare(CLI::App& app, Arguments& arguments) {
  Counts& counts = arguments.counts;
  app.add_option("--only", counts.only, "campaigns whose group, name and variant contain this");
  app.add_option("--seeds", counts.seeds, "seeds per effect and strength, and per other campaign");
  app.add_option("--first-seed", counts.first_seed, "the first of them");
  app.add_option("--nulls", counts.nulls, "campaigns in which nothing is missing");
  app.add_option("--masked-seeds", counts.masked_seeds, "seeds per masked design");
  app.add_option("--strengths", counts.strengths, "of planted effects")->delimiter(',');
  app.add_option("--factors", counts.factors, "of columns of masked designs")->delimiter(',');
  app.add_option("--alpha", arguments.alpha, "family-wise error");
  app.add_option("--threads", arguments.threads, "0: all cores");
  app.add_option("--csv", arguments.csv, "one row per campaign");
  app.add_flag("--show", arguments.show, "print what tracing says of every campaign (stderr)");
  app.add_flag("--search-only", arguments.search_only,
               "all that is significant, whether it pays or not: a tenth of the time");
  app.add_flag("--no-validation", arguments.no_validation,
               "campaigns without validation tests, as most are");
  app.add_flag("--list", arguments.list, "name the campaigns, run nothing");
}

std::string line_of(const Case& c) {
  const Options& o = c.options;
  return fmt::format("{} | {} | {} | {:g} | {} {} | {} tests, {} rows | {} | seed {}", c.group,
                     c.name, c.variant, o.strength, o.kind, o.design, o.tests, o.rows, o.noise,
                     o.seed);
}

std::vector<Result> run_all(const std::vector<Case>& cases, double alpha) {
  std::vector<Result> results(cases.size());
  parallel_for(cases.size(), [&](std::size_t i) {
    results[i] = {&cases[i], judged(cases[i].options, alpha)};
    const Score& score = results[i].score;
    fmt::print(stderr, "{}: {} {} {}| {:.4g} -> {:.4g} ({:.4g}), {:.1f} s | p {:.3g}{}\n",
               line_of(cases[i]), score.verdict, join(score.found, "; "), score.error, score.before,
               score.after, score.oracle, score.seconds, score.p_value, score.why);
  });
  return results;
}

} // namespace
} // namespace frictab::foreign

int main(int argc, char** argv) try {
  using namespace frictab::foreign;
  Arguments arguments;
  CLI::App app("Scores residual tracing on foreign synthetic campaigns");
  declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  frictab::set_threads(arguments.threads);
  auto cases = all_cases(arguments.counts);
  for (Case& c : cases) {
    c.options.show = arguments.show;
    c.options.search_only = arguments.search_only;
    c.options.no_validation = arguments.no_validation;
  }
  if (arguments.list) {
    for (const Case& c : cases)
      fmt::print("{}\n", line_of(c));
    return 0;
  }
  const auto results = run_all(cases, arguments.alpha);
  print_tables(results, arguments.counts);
  if (!arguments.csv.empty()) write_csv(results, arguments.csv);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
