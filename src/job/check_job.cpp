// Checks across keys of a job: missing keys and contradictions.
#include <algorithm>

#include <fmt/format.h>

#include "core/pattern.h"
#include "core/text.h"
#include "core/units.h"
#include "data/quantity.h"
#include "expr/expr.h"
#include "job/key_builder.h"
#include "job/literature.h"
#include "job/reader.h"
#include "models/law.h"
#include "process/quantities.h"

namespace frictab::job {

namespace {

void check_files(JobReader& reader) {
  data::DataOptions& data = reader.job.data;
  if (reader.data_is_no_table) return;
  if (!reader.places.count("data.training")) {
    reader.fault(reader.place_of("data"), "data.training is missing",
                 "write below [data]: training = \"training.csv\"");
    return;
  }
  data.place = reader.place_of("data.training");
  data.oracle_place = reader.place_of("data.oracle");
  reader.job.calibration.place = reader.place_of("calibration.condition_on_mm");
  reader.job.trace.ignore_place = reader.place_of("trace.ignore");
  for (auto& [name, wish] : reader.job.data.roles)
    wish.place = reader.place_of("data.roles." + name);
  reader.job.trace.order_place = reader.place_of("trace.order");
  reader.job.trace.tool_distance_place = reader.place_of("trace.tool_distance");
}

void check_signs(JobReader& reader) {
  const data::DataOptions& data = reader.job.data;
  if (data.delimiter != 0 && data.delimiter == data.decimal)
    reader.fault(reader.place_of("data.delimiter"),
                 fmt::format("data.delimiter and data.decimal are both \"{}\"", data.decimal),
                 "with decimal commas the columns are separated by \";\" or \"\\t\"");
  if (data.thousands != 0 && (data.thousands == data.delimiter || data.thousands == data.decimal))
    reader.fault(reader.place_of("data.thousands"),
                 fmt::format("data.thousands is \"{}\", as {} is", data.thousands,
                             data.thousands == data.decimal ? "data.decimal" : "data.delimiter"),
                 "it is what stands between groups of three digits");
}

void check_unit(JobReader& reader, std::string target, const data::ColumnSource& source,
                const std::string& path) {
  if (source.unit.empty() || source.slope_rows > 0) return; // the loader knows the path's unit
  if (source.area_mm2 > 0) target = "N";
  if (!source.times.empty()) target = "1";
  if (!convert(source.unit, target))
    reader.fault(
        reader.place_of(path + ".unit"),
        fmt::format("{}.unit = {} does not convert to {}", path, toml_quoted(source.unit), target),
        suggest(source.unit, units_like(target)));
}

void check_formula(JobReader& reader, const data::ColumnSource& source, const std::string& path) {
  if (source.formula.empty()) return;
  try {
    expr::parse_expr(source.formula);
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults())
      reader.fault(reader.place_of(path + ".formula"),
                   fmt::format("{}, at character {}", fault.what, fault.place.column), fault.hint);
  }
}

void check_pattern(JobReader& reader, const std::string& text, const Place& place,
                   const std::string& path, bool groups_needed = true) {
  if (text.empty()) return;
  try {
    if (Pattern(text, place).names().empty() && groups_needed)
      reader.fault(place, path + " has no named group",
                   "what becomes a column is written (?<name>...)");
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults())
      reader.faults.push_back(fault);
  }
}

// `quantities`: those that columns of the section may be; another column is a label.
void check_column(JobReader& reader, const std::string& section, const std::string& name,
                  data::ColumnSource& source, std::span<const data::Quantity> quantities) {
  const std::string path = section + "." + name;
  const Place& place = source.place;
  const int ways = !source.times.empty() + (source.area_mm2 > 0) + (source.slope_rows > 0) +
                   !source.formula.empty();
  const bool has_column = !source.names.empty() || source.number > 0;
  if (!has_column) source.names = {name};
  const auto quantity = std::ranges::find(quantities, name, &data::Quantity::name);
  if (quantity == quantities.end()) {
    if (ways > 0 || !source.unit.empty())
      reader.fault(place, path + " is a label: it has no unit and is not computed",
                   "leave only `column`");
    return;
  }
  if (ways > 1)
    reader.fault(place, path + " has more than one of times, area_mm2, slope_rows and formula",
                 "keep the one that says what the column is");
  else if (!source.formula.empty() && has_column)
    reader.fault(place, path + " has a formula and a column", "keep one of the two");
  else if (source.times == name)
    reader.fault(reader.place_of(path + ".times"), path + ".times names the column itself",
                 "a friction coefficient is multiplied with sigma_n_MPa");
  else
    check_unit(reader, quantity->unit, source, path);
  check_formula(reader, source, path);
}

// Finds a times b, b times a; each circle is reported once, at the first of its columns.
template <class Rules>
void check_circle(JobReader& reader, const std::string& section, const Rules& rules,
                  const std::string& first) {
  std::string path = first, at = first;
  for (std::size_t steps = 0; steps <= rules.columns.size(); ++steps) {
    const auto found = rules.columns.find(at);
    if (found == rules.columns.end() || found->second.times.empty()) return;
    at = found->second.times;
    path += " times " + at;
    if (at < first) return; // reported there, or not a circle
    if (at != first) continue;
    if (steps > 0) // else it names itself, which is reported elsewhere
      reader.fault(reader.place_of(section + ".columns." + first + ".times"),
                   "the columns are multiplied in a circle: " + path,
                   "one of them is measured itself: leave its `times` out");
    return;
  }
}

// `section` is "data", or "data.files[1]".
template <class Rules>
void check_mapping(JobReader& reader, const std::string& section, Rules& rules) {
  for (auto& [name, source] : rules.columns)
    check_column(reader, section + ".columns", name, source, data::quantities());
  for (const auto& [name, source] : rules.columns)
    check_circle(reader, section, rules, name);
  for (const auto& [name, value] : rules.constants)
    if (rules.columns.count(name))
      reader.fault(reader.place_of(section + ".constants." + name),
                   fmt::format("{0} stands in [{1}.columns] and in [{1}.constants]", name, section),
                   "keep one of the two");
}

// `path` is "data.files[1]" or "data.join".
void check_segments(JobReader& reader, const std::string& path, data::SegmentRules& rules) {
  rules.place = reader.place_of(path + ".segments.begins");
  check_pattern(reader, rules.begins, rules.place, path + ".segments.begins", false);
  const Place ends = reader.place_of(path + ".segments.ends");
  check_pattern(reader, rules.ends, ends, path + ".segments.ends", false);
  if (!rules.ends.empty() && rules.begins.empty())
    reader.fault(ends, path + ".segments has no begins",
                 "begins = '^Step' says which lines open a run of rows");
}

void check_rule(JobReader& reader, const std::string& path, data::FileRule& rule) {
  check_mapping(reader, path, rule);
  check_segments(reader, path, rule.segments);
  for (const auto& [name, text] : rule.labels)
    if (data::find_quantity(name))
      reader.fault(reader.place_of(path + ".labels." + name), name + " is a quantity, no label",
                   "give it in `constants`");
  for (const auto& [name, value] : rule.constants) // any name is possible there: is it a typo?
    if (const std::string near = nearest_name(name, schema::quantity_names());
        !near.empty() && near != name)
      reader.fault(
          reader.place_of(path + ".constants." + name),
          fmt::format("'{}' in [{}.constants] is not a quantity", name, path),
          fmt::format("did you mean '{}'? A column of your own needs a name less like it", near));
  rule.from_name_place = reader.place_of(path + ".from_name");
  check_pattern(reader, rule.from_name, rule.from_name_place, path + ".from_name");
}

void check_rules(JobReader& reader) {
  std::vector<data::FileRule>& rules = reader.job.data.files;
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const std::string path = fmt::format("data.files[{}]", i + 1);
    check_rule(reader, path, rules[i]);
    if (rules[i].match.empty())
      reader.fault(rules[i].place, path + " has no match", "match = \"*.csv\" says which files");
  }
}

void check_beside(JobReader& reader) {
  data::DataOptions& data = reader.job.data;
  check_rule(reader, "data.join", data.join.how);
  const data::FileRule& how = data.join.how;
  const bool says_how = data.join.offset.value || !how.columns.empty() || !how.constants.empty() ||
                        !how.labels.empty() || !how.from_name.empty();
  if (data.join.files.empty() && says_how)
    reader.fault(data.join.place, "data.join has no files", "files = \"fe/*.csv\" says which");
  data.wide_place = reader.place_of("data.wide.columns");
  data.tests_place = reader.place_of("data.tests");
  data.fill_down_place = reader.place_of("data.fill_down");
  check_segments(reader, "data", data.segments);
  if (data.wide.empty()) return;
  check_pattern(reader, data.wide, data.wide_place, "data.wide.columns");
}

void check_columns(JobReader& reader) {
  data::DataOptions& data = reader.job.data;
  check_mapping(reader, "data", data);
  check_rules(reader);
  check_beside(reader);
  for (const data::DropRule& rule : data.drop) {
    const std::string path = "data.drop." + rule.column;
    const bool said = reader.places.count(path + ".below") ||
                      reader.places.count(path + ".above") || !rule.texts.empty() ||
                      reader.places.count(path + ".texts");
    if (!said)
      reader.fault(rule.place, path + " says neither below nor above nor texts",
                   fmt::format("write {0} = {{ below = 0.1 }}, or {0} = [\"TEXT\"]", rule.column));
    if (rule.below && rule.above && *rule.below >= *rule.above)
      reader.fault(rule.place,
                   fmt::format("{} leaves out every row: below {} and above {}", path, *rule.below,
                               *rule.above),
                   "`below` is the smaller one");
  }
}

void check_axes(JobReader& reader) {
  for (const auto& [name, axis] : reader.job.table.axes) {
    if (!axis.range) continue;
    const std::string path = "table.axes." + name + ".range";
    const data::Quantity& quantity = *data::find_quantity(name);
    const double low = axis.range->first;
    if (low < quantity.lowest)
      reader.fault(reader.place_of(path),
                   fmt::format("{} starts at {}, but {} is never below {}", path, low, name,
                               quantity.lowest),
                   quantity.meaning);
    else if (axis.spacing == "log" && !(low > 0))
      reader.fault(reader.place_of(path),
                   fmt::format("{} starts at {}, but a log axis needs a start > 0", path, low),
                   "raise the start, or spacing = \"linear\"");
  }
}

// Checks that "all" is the only entry, and that a law of a later stage is among those calibrated.
void check_models(JobReader& reader, const std::string& path,
                  const std::vector<std::string>& models) {
  if (models.size() > 1 && std::ranges::count(models, "all"))
    reader.fault(reader.place_of(path), fmt::format("'all' stands alone in {}", path),
                 fmt::format("{} = \"all\", or a list of names", path));
  if (path == "export.targets") return;
  const std::vector<std::string>& use = reader.job.models.use;
  for (const std::string& name : models) {
    const models::Law* law = models::read_model_name(name, reader.job.models.laws).base;
    const bool by_name = !law; // a law of the literature that models.use does not name
    if (by_name) law = models::read_model_name(name, literature()).base;
    if (law && (by_name || (!use.empty() && !std::ranges::count(use, law->name))))
      reader.fault(reader.place_of(path),
                   fmt::format("'{}' in {} is not among models.use", name, path),
                   fmt::format("add {} to models.use{}", law->name == name ? "it" : law->name,
                               use.empty() ? ": [\"all\", \"" + law->name + "\"]" : ""));
  }
}

void check_process(JobReader& reader) {
  process::ProcessOptions& process = reader.job.process;
  for (auto& [name, source] : process.columns)
    check_column(reader, "process.columns", name, source, process::contact_quantities());
  for (auto& [name, source] : process.tool_columns)
    check_column(reader, "process.tool_columns", name, source, process::tool_quantities());
  for (const auto& [name, value] : process.constants) {
    if (process.columns.count(name))
      reader.fault(reader.place_of("process.constants." + name),
                   name + " stands in [process.columns] and in [process.constants]",
                   "keep one of the two");
    if (const data::Quantity& quantity = *data::find_quantity(name); value < quantity.lowest)
      reader.fault(reader.place_of("process.constants." + name),
                   fmt::format("process.constants.{} is {}", name, value),
                   fmt::format("a {} cannot be below {}", quantity.meaning, quantity.lowest));
  }
}

void remember_inputs(JobReader& reader) {
  codegen::ExportOptions& exports = reader.job.exports;
  const auto remember = [&](const std::string& section, const auto& inputs) {
    for (const auto& [name, choice] : inputs)
      exports.input_places[section + name] = reader.place_of(section + name);
  };
  remember("export.inputs.", exports.inputs);
  for (const auto& [target, inputs] : exports.inputs_of_target)
    remember("export." + target + ".inputs.", inputs);
}

} // namespace

// A constant that is not a quantity is allowed only for a law of the job that needs it.
void check_constants(JobReader& reader) {
  const models::Conventions conventions{.shear_limit = false};
  for (const auto& constant : reader.job.data.constants) {
    const std::string& name = constant.first;
    const auto& laws = reader.job.models.laws.own();
    const bool needed = std::ranges::any_of(laws, [&](const auto& law) {
      if (!law->build) return false; // its own faults are reported
      const std::vector<std::string> inputs = models::inputs(*law, conventions);
      return std::ranges::count(inputs, name) > 0;
    });
    if (!data::find_quantity(name) && !needed)
      reader.fault(reader.place_of("data.constants." + name),
                   fmt::format("unknown quantity '{}' in [data.constants]", name),
                   suggest(name, schema::constant_names()) +
                       "; another one stands there only where a law of the job needs it");
  }
}

void check_job(JobReader& reader) {
  check_files(reader);
  check_signs(reader);
  check_columns(reader);
  check_constants(reader);
  check_axes(reader);
  check_models(reader, "models.use", reader.job.models.use);
  check_models(reader, "table.model", reader.job.table.model);
  check_models(reader, "trace.models", reader.job.trace.models);
  check_process(reader);
  check_models(reader, "export.targets", reader.job.exports.targets);
  remember_inputs(reader);
}

} // namespace frictab::job
