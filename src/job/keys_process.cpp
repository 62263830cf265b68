// The keys of [process]: the user's own simulation, in which the laws are judged.
#include "data/quantity.h"
#include "job/key_builder.h"
#include "process/quantities.h"

namespace frictab::job::schema {

using process::Driven;
using process::ProcessOptions;

template <> std::vector<std::string> words_of<Driven>() {
  return {"auto", "displacement", "force", "energy"};
}

namespace {

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

std::vector<KeyRule> own_keys() {
  const KeysOf process("process", part_of<&Job::process>);
  return {
      process(
          "contact", &ProcessOptions::contact,
          "contact states of a simulation of yours, one row per increment and facet or node that "
          "touches: files, folders or names with *; `frictab explain process` has the columns",
          "no process", "\"contact.csv\"") |
          names_files,
      process("tool", &ProcessOptions::tool,
              "force and speed of the tool over time: time_s, force_kN, speed_mm_s, and where "
              "known stroke_mm and friction_J, the solver's own friction work",
              "friction work instead of the force", "\"tool.csv\"") |
          names_files,
      process("used", &ProcessOptions::used,
              "law that the simulation had: a calibrated one, or coulomb:MU, shear:M",
              "the shear stress tau_R_MPa of the contact file", "\"coulomb:0.08\""),
      process("symmetry", &ProcessOptions::symmetry,
              "the tool's force acts on so many times the areas given: 2 where a half was modelled "
              "and the force is that of the whole, or where one of two equal platens was written") |
          above(0),
      process("driven", &ProcessOptions::driven,
              "what moves the tool: displacement, force or energy; under a given force or energy "
              "no change of force is predicted. auto: force, where the force is a straight line "
              "over time and the speed is not steady; else displacement") |
          Allowed{"", words_of<Driven>},
      process("fixed_contact", &ProcessOptions::fixed_contact,
              "false: another friction makes another contact, as where a die is filled; then no "
              "change of force is predicted"),
      process("flow_curve", &ProcessOptions::flow_curve,
              "a file of plastic_strain and sigma_f_MPa: gives the flow stress of contact files "
              "with plastic_strain; linear, held at its ends",
              "sigma_f_MPa of the contact file", "\"flow_curve.csv\"") |
          names_files,
      process("tests", &ProcessOptions::tests, "number of tests to propose") | at_least(1, 20),
      process("repeats", &ProcessOptions::repeats,
              "how many of the proposed tests are run twice, to know the scatter") |
          at_least(0, 20),
      process("resamples", &ProcessOptions::resamples,
              "resamples of the tests in which laws are fitted and chosen again; 0: none") |
          at_least(0, 10000),
      process("add", &ProcessOptions::add,
              "files of further tests, read as data.training: says what the laws say of the "
              "process with them and without",
              "none", "\"new_tests.csv\"") |
          names_files,
      key(
          "process.constants.*",
          [](Job & job, const std::string& name) -> auto& { return job.process.constants[name]; },
          "a state that is the same at every contact, in its canonical unit",
          "from the contact file", "60.0"),
      key(
          "process.rig.*",
          [](Job & job, const std::string& name) -> auto& { return job.process.rig[name]; },
          "what the rig reaches", "Table 1, or what the tests reach beyond it", "[100, 2750]") |
          rig_problem,
  };
}

} // namespace

std::vector<KeyRule> process_keys() {
  std::vector<KeyRule> rules = own_keys();
  for (auto* const make : {column_key, unit_key, formula_key})
    rules.push_back(make("process.columns", contact_column));
  for (auto* const make : {column_key, unit_key, formula_key})
    rules.push_back(make("process.tool_columns", tool_column));
  return rules;
}

} // namespace frictab::job::schema
