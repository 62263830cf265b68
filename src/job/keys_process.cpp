// The keys of [process]: the user's own simulation, in which the laws are judged.
#include <algorithm>
#include <array>

#include "data/quantity.h"
#include "job/key_builder.h"
#include "process/quantities.h"

namespace frictab::job::schema {

using process::Driven;

namespace {

std::vector<std::string> ways_to_drive() {
  return {"auto", "displacement", "force", "energy"}; // in the order of process::Driven
}

Problem rig_problem(const std::string& name, const KeyValue& value) {
  const data::Quantity& quantity = *data::find_quantity(name);
  const double low = std::get<std::pair<double, double>>(value).first;
  const bool is_zero = quantity.log_axis && low <= 0;
  if (low >= quantity.lowest && !is_zero) return {};
  return {"starts at " + shortest(low) + ": too low for a " + quantity.meaning,
          "[from, to] in " + quantity.unit};
}

data::ColumnSource& contact_column(Job& job, const std::string& name) {
  return job.process.columns[name];
}
data::ColumnSource& tool_column(Job& job, const std::string& name) {
  return job.process.tool_columns[name];
}

template <SourceOf source> std::vector<KeyRule> source_keys(const std::string& section) {
  return {column_key<source>(section), unit_key<source>(section), formula_key<source>(section)};
}

std::vector<KeyRule> own_keys() {
  return {
      key<std::vector<std::string>>(
          "process.contact", [](Job & job) -> auto& { return job.process.contact; },
          "contact states of a simulation of yours, one row per increment and facet or node that "
          "touches: files, folders or names with *; `frictab explain process` has the columns",
          "no process", "\"contact.csv\""),
      key<std::vector<std::string>>(
          "process.tool", [](Job & job) -> auto& { return job.process.tool; },
          "force and speed of the tool over time: time_s, force_kN, speed_mm_s, and where known "
          "stroke_mm and friction_J, the solver's own friction work",
          "friction work instead of the force", "\"tool.csv\""),
      key<std::string>(
          "process.used", [](Job & job) -> auto& { return job.process.used; },
          "law that the simulation had: a calibrated one, or coulomb:MU, shear:M",
          "the shear stress tau_R_MPa of the contact file", "\"coulomb:0.08\""),
      key<double>(
          "process.symmetry", [](Job & job) -> auto& { return job.process.symmetry; },
          "the tool's force acts on so many times the areas given: 2 where a half was modelled and "
          "the force is that of the whole, or where one of two equal platens was written") |
          above(0),
      key<Driven>(
          "process.driven", [](Job & job) -> auto& { return job.process.driven; },
          "what moves the tool: displacement, force or energy; under a given force or energy no "
          "change of force is predicted. auto: force, where the force is a straight line over time "
          "and the speed is not steady; else displacement") |
          Allowed{"", ways_to_drive},
      key<bool>(
          "process.fixed_contact", [](Job & job) -> auto& { return job.process.fixed_contact; },
          "false: another friction makes another contact, as where a die is filled; then no change "
          "of force is predicted"),
      key<std::string>(
          "process.flow_curve", [](Job & job) -> auto& { return job.process.flow_curve; },
          "a file of plastic_strain and sigma_f_MPa: gives the flow stress of contact files with "
          "plastic_strain; linear, held at its ends",
          "sigma_f_MPa of the contact file", "\"flow_curve.csv\""),
      key<std::size_t>(
          "process.tests", [](Job & job) -> auto& { return job.process.tests; },
          "number of tests to propose") |
          at_least(1, 20),
      key<std::size_t>(
          "process.repeats", [](Job & job) -> auto& { return job.process.repeats; },
          "how many of the proposed tests are run twice, to know the scatter") |
          at_least(0, 20),
      key<std::size_t>(
          "process.resamples", [](Job & job) -> auto& { return job.process.resamples; },
          "resamples of the tests in which laws are fitted and chosen again; 0: none") |
          at_least(0, 10000),
      key<std::vector<std::string>>(
          "process.add", [](Job & job) -> auto& { return job.process.add; },
          "files of further tests, read as data.training: says what the laws say of the process "
          "with them and without",
          "none", "\"new_tests.csv\""),
      named<double>(
          "process.constants.*",
          [](Job & job, const std::string& name) -> auto& { return job.process.constants[name]; },
          "a state that is the same at every contact, in its canonical unit",
          "from the contact file", "60.0"),
      named<std::pair<double, double>>(
          "process.rig.*",
          [](Job & job, const std::string& name) -> auto& { return job.process.rig[name]; },
          "what the rig reaches", "Table 1, or what the tests reach beyond it", "[100, 2750]") |
          rig_problem,
  };
}

} // namespace

template <> Driven Kind<Driven>::from(KeyValue& v) {
  const std::vector<std::string> words = ways_to_drive();
  const auto at = std::find(words.begin(), words.end(), std::get<std::string>(v));
  return static_cast<Driven>(at - words.begin());
}

template <> std::string Kind<Driven>::show(Driven v) {
  return toml_quoted(ways_to_drive()[static_cast<std::size_t>(v)]);
}

std::vector<KeyRule> process_keys() {
  std::vector<KeyRule> rules = own_keys();
  for (std::vector<KeyRule>& more : std::array{source_keys<contact_column>("process.columns"),
                                               source_keys<tool_column>("process.tool_columns")})
    for (KeyRule& rule : more)
      rules.push_back(std::move(rule));
  return rules;
}

} // namespace frictab::job::schema
