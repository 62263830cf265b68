// Texts of topics, and tables made from the registries.
#include "cli/topics.h"

#include <fmt/format.h>

#include "codegen/solver_units.h"
#include "core/text.h"
#include "data/quantity.h"
#include "data/rules.h"

namespace frictab::cli {

namespace {

Explanation about_experiment() {
  return {
      "experiment",
      "topic",
      "one tribometer test: the statistical unit. Splits, cross-validation, standard errors and "
      "intervals never cut through one",
      {{"column", "experiment: a text or a whole number in every row"},
       {"without it", "data.experiment says what a test is: file, file+COLUMN, COLUMN, interval (a "
                      "header that comes again begins the next) or pause"},
       {"order", "of rows within an experiment: time"},
       {"what it has", "a table of one row per experiment (humidity, batch, tool): data.tests"},
       {"least", "2 rows; with fewer than 30 experiments and no validation files each is left out "
                 "in turn"}}};
}

Explanation about_units() {
  Explanation out{"units",
                  "topic",
                  "every quantity has one unit inside and in every file; data in others are "
                  "converted, where the job or the header says which",
                  {{"in the header", "after a name, as in `Normalkraft [kN]`, `F_R (N)`, `T / "
                                     "degC`; or in a row of its own (data.units_row)"},
                   {"in the job", "sigma_n_MPa = { column = \"Normal stress\", unit = \"Pa\" }"},
                   {"known", "what UDUNITS-2 knows; what does not convert is an error"},
                   {"routines", codegen::unit_systems_text() +
                                    ": export.units; degC or K: export.temperature"}},
                  "units inside",
                  {}};
  for (const data::Quantity& quantity : data::quantities())
    out.items.push_back({quantity.name, fmt::format("[{}] {}", quantity.unit, quantity.meaning)});
  return out;
}

Explanation about_csv() {
  return {
      "csv",
      "topic",
      "rows as text, one column per quantity; a rig's file is read as it is",
      {{"columns", "canonical names (frictab list quantities), or any, mapped in [data.columns]"},
       {"needed", "experiment, sigma_n_MPa and tau_R_MPa, or F_R_N and F_N_N with a contact normal "
                  "stress; more where a law asks for more (frictab explain LAW)"},
       {"dialect",
        "delimiter , ; tab or blanks is found; a decimal comma is set, or found by frictab init "
        "--from; data.delimiter, data.decimal, data.thousands, data.skip_rows say them"},
       {"encoding", "UTF-8, UTF-16, Latin-1; any line ends; preambles above the header"},
       {"empty cells", "an error, or rows left out and counted: data.missing = \"drop\""},
       {"others", "bystanders: no law uses them, trace may; a text column is categorical"},
       {"guess", "frictab init --from FILES makes a job from the files, frictab data JOB shows "
                 "what is read"}}};
}

Explanation about_rules() {
  Explanation out{
      "rules",
      "topic",
      "what reading takes columns, rows and tests for, what it does then, and how the job "
      "overrules it; frictab data JOB shows each call",
      {{"called wrongly",
        "where there was nothing of the kind, in synthetic data: docs/measurements.md, Reading"}},
      "rules",
      {}};
  for (const data::ReadingRule& rule : data::reading_rules()) {
    std::string wrong = "not measured";
    if (rule.wrong.of > 0)
      wrong = fmt::format("{} of {} {}", thousands(rule.wrong.calls), thousands(rule.wrong.of),
                          rule.wrong.chances);
    out.items.push_back({fmt::format("{}: {}", rule.about, rule.name),
                         rule.when,
                         {{"then", rule.then},
                          {"overruled by", rule.overruled_by},
                          {"called wrongly", std::move(wrong)}}});
  }
  return out;
}

Explanation about_compilers() {
  return {"compilers",
          "topic",
          "programs that verify and export --check start: compilers, and interpreters of Lua",
          {{"looked for", "in the folders of PATH that are absolute, not the working directory and "
                          "not writable by everybody; frictab doctor shows what is found"},
           {"time", "120 s each; FRICTAB_COMPILE_SECONDS=N in the environment allows N"},
           {"memory", "8 GiB for each of its processes; FRICTAB_COMPILE_GIB=N allows N"},
           {"files", "of at most 2 GiB; of what it prints the beginning and the end are kept"}}};
}

Explanation about_exit_codes() {
  return {
      "exit-codes",
      "topic",
      "what a command ends with",
      {},
      "codes",
      {{"0", "done"},
       {"1",
        "a target was missed: drift over tolerance, a file that was changed, a routine that does "
        "not compile, a table over its tolerance, tables further apart than `table diff "
        "--max-MPa`"},
       {"2",
        "usage, job file or input data wrong; results stale or missing. Nothing was written (by "
        "`verify` only `verify.xml`); by `study run` all campaigns but those that failed"},
       {"3", "anything else: a full disk, no memory, `doctor` that misses something"},
       {"128 + n", "ended by signal n, for example 130 by Ctrl-C"}}};
}

struct Topic {
  const char* name;
  Explanation (*about)();
};

const std::vector<Topic>& topics() {
  static const std::vector<Topic> all = {{"experiment", about_experiment},
                                         {"units", about_units},
                                         {"csv", about_csv},
                                         {"rules", about_rules},
                                         {"compilers", about_compilers},
                                         {"exit-codes", about_exit_codes}};
  return all;
}

} // namespace

const std::vector<std::string>& topic_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out;
    for (const Topic& topic : topics())
      out.emplace_back(topic.name);
    return out;
  }();
  return names;
}

std::optional<Explanation> explain_topic(const std::string& name) {
  for (const Topic& topic : topics())
    if (name == topic.name) return topic.about();
  return std::nullopt;
}

} // namespace frictab::cli
