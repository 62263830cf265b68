// Sections of the job file, look-up, and the description of a key's possible values.
#include "job/schema.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "job/key_builder.h"
#include "process/quantities.h"

namespace frictab::job {

namespace {

Place* data_place(Job& job, const std::string&) {
  return &job.data.place;
}
Place* column_place(Job& job, const std::string& name) {
  return &job.data.columns[name].place;
}
Place* join_place(Job& job, const std::string&) {
  return &job.data.join.place;
}
Place* join_column_place(Job& job, const std::string& name) {
  return &job.data.join.how.columns[name].place;
}
Place* file_place(Job& job, const std::string& name) {
  return &schema::file_rule(job, name).place;
}
Place* file_column_place(Job& job, const std::string& name) {
  return &schema::file_rule(job, name).columns[last_part(name)].place;
}
std::vector<std::string> no_names() {
  return {};
}
Place* drop_place(Job& job, const std::string& name) {
  return &schema::drop_rule(job, name).place;
}
Place* models_place(Job& job, const std::string&) {
  return &job.models.place;
}
Place* law_place(Job& job, const std::string& name) {
  return &schema::law_text(job, name).place;
}
Place* parameter_place(Job& job, const std::string& name) {
  return &schema::parameter_text(job, name).place;
}
Place* table_place(Job& job, const std::string&) {
  return &job.table.place;
}
Place* axis_place(Job& job, const std::string& name) {
  return &job.table.axes[name].place;
}
Place* export_place(Job& job, const std::string&) {
  return &job.exports.place;
}

Place* process_place(Job& job, const std::string&) {
  return &job.process.place;
}
Place* contact_column_place(Job& job, const std::string& name) {
  return &job.process.columns[name].place;
}
Place* tool_column_place(Job& job, const std::string& name) {
  return &job.process.tool_columns[name].place;
}

std::string either(const std::vector<std::string>& words) {
  std::vector<std::string> quoted = toml_quoted(words);
  const std::string last = quoted.back();
  quoted.pop_back();
  return quoted.empty() ? last : join(quoted, ", ") + " or " + last;
}

std::string with_bounds(const std::string& noun, const ValueBounds& bounds) {
  const bool low = bounds.lower > -schema::infinite;
  const bool high = bounds.upper < schema::infinite;
  std::string text = noun;
  if (low) text += fmt::format(" {} {}", bounds.open_lower ? ">" : ">=", bounds.lower);
  if (high)
    text += fmt::format("{} {} {}", low ? " and" : "", bounds.open_upper ? "<" : "<=",
                        bounds.upper == std::floor(bounds.upper)
                            ? fmt::format("{:.0f}", bounds.upper) // 1000000, not 1e+06
                            : fmt::format("{}", bounds.upper));
  return text;
}

} // namespace

const std::vector<KeyRule>& key_rules() {
  static const std::vector<KeyRule> rules = [] {
    std::vector<KeyRule> all = schema::data_keys();
    for (KeyRule& rule : schema::stage_keys())
      all.push_back(std::move(rule));
    return all;
  }();
  return rules;
}

const std::vector<SectionRule>& section_rules() {
  static const std::vector<SectionRule> rules = {
      {"data", "what was measured, and how the rig's file is read", "", nullptr, data_place},
      {"data.drop",
       "rows left out by a quantity or a recorded column, counted in the report",
       "drop = { tau_R_MPa = { below = 0.1 }, valid = [\"FALSE\"] }",
       schema::quantity_names,
       nullptr,
       "column",
       true,
       false,
       {},
       true},
      {"data.drop.*",
       "limits of one column, or texts; a text or a list of them instead of a table is its `texts`",
       "", nullptr, drop_place, "column", false, false, "texts"},
      {"data.columns", "canonical name = the file's own, with its unit where it differs",
       "sigma_n_MPa = { column = \"Normal stress\", unit = \"Pa\" }\n"
       "tau_R_MPa = { column = \"Friction\", times = \"sigma_n_MPa\" }\n"
       "v_rel_mm_s = { formula = \"rpm*radius_mm*2*pi/60\" }",
       schema::column_names, nullptr},
      {"data.columns.*",
       "how one canonical column is taken from the file; a text or a number instead of a table is "
       "its `column`",
       "", nullptr, column_place, "quantity", false, false, "column"},
      {"data.constants", "quantities, or inputs of a law, that are the same for every row",
       "sigma_f_MPa = 480.0", schema::constant_names, nullptr, "quantity", true},
      {"data.roles",
       "what recorded columns are, where it is not what `frictab data` infers",
       "acoustic_V = \"channel\"",
       no_names,
       nullptr,
       "recorded column",
       true,
       false,
       {},
       true},
      {"data.files",
       "what is special about some files: [[data.files]] stands once per rule, with any of the "
       "keys below; the first rule that matches a file counts",
       "match = \"pin_*.csv\"\nlabels = { material = \"316SS\" }\n"
       "from_name = '_(?<radius_mm>\\d+)mm'",
       nullptr, nullptr, "rule", false, true},
      {"data.files.*", "one rule", "", nullptr, file_place},
      {"data.files.*.columns", "as data.columns, and instead of it", "", schema::column_names,
       nullptr},
      {"data.files.*.columns.*", "as data.columns", "", nullptr, file_column_place, "quantity",
       false, false, "column"},
      {"data.files.*.constants", "values that are the same for every row of these files", "",
       schema::constant_names, nullptr, "quantity", true},
      {"data.files.*.labels", "texts that are the same for every row of these files", "", no_names,
       nullptr, "label", true},
      {"data.wide", "tables with one column per test: they are read as one row per value",
       "columns = 'OA(?<oa_pct>\\d+)_(?<experiment>.*)'", nullptr, nullptr},
      {"data.segments", "lines that cut a file into runs of rows, as machines write steps",
       "begins = '^Step (?<step>\\d+)'\nends = '^End of step'", nullptr, nullptr},
      {"data.files.*.segments", "as data.segments", "", nullptr, nullptr},
      {"data.join.segments", "as data.segments", "", nullptr, nullptr},
      {"data.join",
       "other files of the same tests, with a clock of their own, as their simulations: their "
       "columns are brought onto the rows of the tests, with the keys of [[data.files]]",
       "files = \"fe/*.csv\"", nullptr, join_place},
      {"data.join.columns", "as data.columns, of these files", "", schema::column_names, nullptr},
      {"data.join.columns.*", "as data.columns", "", nullptr, join_column_place, "quantity", false,
       false, "column"},
      {"data.join.constants", "values that are the same for every row of these files", "",
       schema::constant_names, nullptr, "quantity", true},
      {"data.join.labels", "texts that are the same for every row of these files", "", no_names,
       nullptr, "label", true},
      {"models", "which friction laws", "", no_names, models_place, "law", true},
      {"models.*", "a law of your own, by its name: calibrated, proven, exported like the others",
       "formula = \"min(mu*sigma_n_MPa, m*k_MPa)\"\n"
       "parameters = { mu = { range = [0, 1] }, m = { range = [0, 1] } }",
       nullptr, law_place},
      {"models.*.where", "named parts of its formulas", "", no_names, nullptr, "part", true},
      {"models.*.parameters",
       "what its formulas leave open; a number instead of a table is its `value`", "", no_names,
       nullptr, "parameter", true},
      {"models.*.parameters.*", "one parameter", "", nullptr, parameter_place, "parameter", false,
       false, "value"},
      {"calibration", "how their parameters are found", "", nullptr, nullptr},
      {"table", "the table that replaces the law", "", nullptr, table_place},
      {"table.axes", "axes by canonical name; what is left out is chosen by the tool", "",
       schema::state_names, nullptr},
      {"table.axes.*", "one axis", "range = [5, 500]\nnodes = 17\nspacing = \"log\"", nullptr,
       axis_place},
      {"table.hdf5", "how the values lie in the table's file; every HDF5 reader undoes it", "",
       nullptr, nullptr},
      {"export", "the friction routines", "", schema::target_names, export_place},
      {"export.inputs",
       "where states come from that the solver does not give; [export.TARGET.inputs] says it for "
       "one target alone",
       "psi = \"constant:1.0\"", schema::state_names, nullptr, "quantity", true},
      {"export.*", "what holds for one target alone", "", nullptr, nullptr},
      {"export.*.inputs", "as export.inputs, and instead of it", "psi = \"field:1\"",
       schema::state_names, nullptr, "quantity", true},
      {"export.options", "choices that targets offer, by the names `frictab explain TARGET` lists",
       "", schema::option_names, nullptr, "option"},
      {"verify", "the proof of drift", "", nullptr, nullptr},
      {"trace", "the search for effects a law lacks", "", nullptr, nullptr},
      {"process", "a simulation of yours, in which the laws are judged before it is rerun", "",
       nullptr, process_place},
      {"process.columns", "columns of the contact files: the name here = the file's own",
       "sigma_n_MPa = { column = \"CPRESS\", unit = \"Pa\" }", process::contact_columns, nullptr},
      {"process.columns.*", "how one column is taken from the file", "", nullptr,
       contact_column_place, "quantity", false, false, "column"},
      {"process.tool_columns", "columns of the tool's file: the name here = the file's own",
       "force_kN = { column = \"RF2\", unit = \"N\" }", process::tool_columns, nullptr},
      {"process.tool_columns.*", "how one column is taken from the file", "", nullptr,
       tool_column_place, "quantity", false, false, "column"},
      {"process.constants", "states that the contact files lack", "T_contact_C = 60.0",
       schema::state_names, nullptr},
      {"process.rig", "what the rig can be set to, for the tests that are proposed",
       "sigma_n_MPa = [100, 2750]", process::rig_settings, nullptr},
      {"output", "where results go", "", nullptr, nullptr},
  };
  return rules;
}

const KeyRule* find_key(const std::string& path, bool of_program) {
  static const std::vector<KeyRule> registry_keys = schema::registry_law_keys();
  const auto is_it = [&](const KeyRule& rule) { return rule.path == path; };
  for (const auto* rules : {&key_rules(), of_program ? &registry_keys : nullptr})
    if (rules)
      if (const auto found = std::ranges::find_if(*rules, is_it); found != rules->end())
        return &*found;
  return nullptr;
}

const SectionRule* find_section(const std::string& path) {
  const auto& rules = section_rules();
  const auto found = std::ranges::find(rules, path, &SectionRule::path);
  return found == rules.end() ? nullptr : &*found;
}

std::vector<std::string> fixed_names(const std::string& section) {
  std::vector<std::string> names;
  const auto add = [&](const auto& rules) {
    for (const auto& rule : rules)
      if (parent_of(rule.path) == section && last_part(rule.path) != "*")
        names.push_back(last_part(rule.path));
  };
  add(section_rules());
  add(key_rules());
  return names;
}

std::string expected(const KeyRule& rule) {
  if (rule.allowed.names && rule.allowed.noun.empty()) return either(rule.allowed.names());
  std::string noun = rule.allowed.names ? "the name of a " + rule.allowed.noun : "a text";
  switch (rule.type) {
  case KeyType::text:
    return noun;
  case KeyType::texts:
    return noun + (rule.allowed.names ? " or a list of them" : " or a list of texts");
  case KeyType::column:
    return "a text, a list of texts or " + with_bounds("a column number", rule.bounds);
  case KeyType::whole:
    return with_bounds("a whole number", rule.bounds);
  case KeyType::number:
    return with_bounds("a number", rule.bounds);
  case KeyType::automatic:
    return "\"auto\" or " + with_bounds("a number", rule.bounds);
  case KeyType::numbers:
    return with_bounds("a number", rule.bounds) + ", or a list of such numbers";
  case KeyType::range:
    return "two numbers [from, to] with from < to";
  case KeyType::flag:
    return "true or false";
  }
  return "";
}

std::string default_text(const KeyRule& rule) {
  return rule.show ? rule.show(Job{}) : "";
}

} // namespace frictab::job
