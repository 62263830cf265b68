// Reads explanations from the registries and the job schema: nothing is written twice.
#include "cli/explanation.h"

#include <algorithm>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "cli/command_tree.h"
#include "cli/topics.h"
#include "codegen/exporter.h"
#include "core/names.h"
#include "core/text.h"
#include "data/quantity.h"
#include "effects/effect.h"
#include "job/literature.h"
#include "job/schema.h"
#include "job/systems.h"
#include "models/law.h"
#include "process/quantities.h"

namespace frictab::cli {

namespace {

using Item = Explanation::Item;

std::vector<Item> parameter_items(const std::vector<models::Parameter>& parameters, bool fixed) {
  std::vector<Item> items;
  for (const models::Parameter& p : parameters) {
    Item item{p.name, p.meaning, {{"unit", p.unit}}};
    item.fields.push_back({fixed ? "value" : "start", shortest(p.start)});
    if (!fixed) item.fields.push_back({"bounds", shortest(p.lower) + " .. " + shortest(p.upper)});
    items.push_back(std::move(item));
  }
  return items;
}

std::string how_calibrated(const models::Law& law) {
  if (!law.clamped_inputs.empty()) return "no: a table, taken as it is";
  switch (law.calibrated) {
  case models::Calibrated::fixed:
    return "no: constants of the literature";
  case models::Calibrated::mean:
    return "means of mu_meas and m_meas over the training rows";
  case models::Calibrated::fit:
    return "by calibration.loss";
  case models::Calibrated::train:
    return "trained on squared residuals of tau_R; weight decay by cross-validation over "
           "experiments";
  case models::Calibrated::regress:
    return "by generalised least squares of ln mu over bins of rows; orders averaged by "
           "cross-validation over experiments, scatter and ridge by restricted likelihood";
  }
  return "";
}

std::string remarks_of(const models::Law& law) {
  std::vector<std::string> remarks;
  if (law.log_value) remarks.push_back("tabulated as its logarithm");
  for (const auto& [axis, positions] : law.kinks) {
    std::vector<std::string> at;
    for (const double position : positions)
      at.push_back(shortest(position));
    constexpr std::size_t most = 8; // limit; a table may have hundreds of nodes
    const std::string places = at.size() <= most ? join(at, ", ")
                                                 : fmt::format("{}, {}, ... {} ({} places)", at[0],
                                                               at[1], at.back(), at.size());
    remarks.push_back(fmt::format("kink on {} at {}: gets a node", axis, places));
  }
  for (const auto& [input, ends] : law.clamped_inputs)
    remarks.push_back(fmt::format("held below {} {} and above {}", input, shortest(ends.first),
                                  shortest(ends.second)));
  remarks.push_back("limited to 0 <= tau_R <= k where the data have sigma_f_MPa "
                    "(models.shear_limit; k by models.shear_yield)");
  return join(remarks, "; ");
}

Explanation about(const models::Law& law) {
  const models::Conventions usual;
  std::vector<std::string> free_inputs =
      models::inputs(law, models::Conventions{usual.shear_yield, usual.k_over_sigma_f, false});
  Explanation out{law.name, "friction law", law.title, {}, "parameters"};
  out.fields = {{"formula", law.formula},
                {"inputs", join(free_inputs, ", ")},
                {"may use", join(law.may_use, ", ")},
                {"calibrated", how_calibrated(law)},
                {"tabulated", quantity_name(law.quantity)},
                {"reference", law.reference},
                {"remarks", remarks_of(law)}};
  if (!models::is_registered(law)) { // for a user's law: the formula as it was parsed
    const models::Formula parts = law.build(usual);
    out.fields.push_back({"value", expr::to_text(parts.value)});
    out.fields.push_back({"tau_R of it", expr::to_text(parts.combine)});
  }
  out.items = parameter_items(law.parameters, law.calibrated == models::Calibrated::fixed);
  return out;
}

std::string what_it_takes(const effects::EffectForm& effect) {
  if (effect.columns == 1)
    return effect.texts == 0 ? "one column" : "a text column: one factor per level";
  const std::string count = effect.columns == 2 ? "two columns" : "three columns";
  return count + (effect.texts == 0 ? "" : effect.texts == 1 ? ", the first of text" : " of text");
}

Explanation about(const effects::EffectForm& effect) {
  Explanation out{effect.name, "effect", effect.title, {}, "parameters"};
  out.fields = {{"formula", effect.formula}, {"acts on", what_it_takes(effect)}};
  out.items = parameter_items(effect.parameters, false);
  return out;
}

Explanation about(const codegen::Exporter& target) {
  Explanation out{target.name, "target", target.title, {}, "choices in [export.options]"};
  out.fields = {{"signature", target.signature_source}, {"notes", target.notes}};
  if (target.combines()) out.fields.push_back({"laws distinguished by", target.several_laws});
  for (const codegen::ExportOption& option : target.options) {
    Explanation::Item& item = out.items.emplace_back();
    item = {option.name, option.meaning, {}};
    if (!option.fault) item.fields.push_back({"one of", join(option.allowed, ", ")});
    item.fields.push_back({"default", option.allowed.front()});
  }
  return out;
}

Explanation about(const data::Quantity& quantity) {
  Explanation out{quantity.name, "quantity", quantity.meaning};
  out.fields = {{"symbol", quantity.symbol}, {"unit", quantity.unit}};
  if (quantity.lowest > -std::numeric_limits<double>::infinity())
    out.fields.push_back({"lowest", shortest(quantity.lowest)});
  if (quantity.paper_range)
    out.fields.push_back({"range of the paper", fmt::format("{} .. {}", quantity.paper_range->first,
                                                            quantity.paper_range->second)});
  if (quantity.state)
    out.fields.push_back({"axis", quantity.log_axis ? "log by default" : "linear by default"});
  return out;
}

Explanation::Fields key_fields(const job::KeyRule& rule) {
  const std::string normal = job::default_text(rule);
  Explanation::Fields fields{{"value", job::expected(rule)}, {"default", normal}};
  if (normal.empty()) fields.back() = {"absent", rule.absent};
  if (!rule.example.empty()) fields.push_back({"example", rule.example});
  return fields;
}

Explanation about(const job::KeyRule& rule) {
  return {rule.path, "job key", rule.meaning, key_fields(rule)};
}

bool is_below(const std::string& path, const std::string& section) {
  return section.empty() || path.starts_with(section + ".");
}

Explanation about_section(const std::string& path, const std::string& title) {
  Explanation out{path.empty() ? "job" : path, "job section", title, {}, "keys"};
  for (const job::KeyRule& rule : job::key_rules())
    if (is_below(rule.path, path)) out.items.push_back({rule.path, rule.meaning, key_fields(rule)});
  return out;
}

// [process]: the columns of its files, then the keys.
Explanation about_process(const std::string& title) {
  Explanation out = about_section("process", title);
  out.fields = {
      {"contact", "one row per written increment and facet (or node) that touches: time_s, facet, "
                  "area_mm2, sigma_n_MPa, and v_rel_mm_s or slip_1_mm and slip_2_mm"},
      {"derived", "v_rel_mm_s from slips, as a vector; s_mm since each facet first touched; psi "
                  "from area_mm2/area_start_mm2; sigma_f_MPa by process.flow_curve or a formula"},
      {"held", "what is missing: psi at 1, other states at the median of the tests, with what that "
               "may cost"},
      {"tool", "time_s, force_kN, speed_mm_s; stroke_mm, and friction_J, which shows a wrong "
               "symmetry or unit"},
      {"files",
       "as [data] reads them: text, workbooks, HDF5, MATLAB, several files, other names and units"},
      {"scripts", "frictab process --script abaqus, calculix, deform, getfem, lsdyna"},
      {"first order", "a force's change at the motion as it was; for the shape of the part only "
                      "its sign, none under a given force or energy; beyond 10 % rerun"}};
  std::vector<Explanation::Item> columns;
  const auto add = [&](const char* file, std::span<const data::Quantity> quantities) {
    for (const data::Quantity& quantity : quantities)
      columns.push_back({fmt::format("{}: {}", file, quantity.name),
                         fmt::format("[{}] {}", quantity.unit, quantity.meaning)});
  };
  add("contact", process::contact_quantities());
  add("tool", process::tool_quantities());
  out.items_label = "columns, then keys";
  out.items.insert(out.items.begin(), columns.begin(), columns.end());
  return out;
}

// Layout required of a table made elsewhere: `verify --table`, `export --table` and `table` read
// it.
Explanation about_table_layout() {
  Explanation out{"table-layout",
                  "file",
                  "a table as netCDF-4-compatible HDF5: one dataset `value` and one dimension "
                  "scale per axis, in the root group; made by frictab or by anyone else",
                  {},
                  "datasets and attributes",
                  {}};
  out.fields = {
      {"tau_R", "the formula `combine` of the interpolated value, the states and the constants"},
      {"axes", "1 to 8, or none for a constant; outside, the nearest edge is used, or what "
               "outside_low and outside_high say"},
      {"not needed", "all other attributes; frictab writes model, data_hash, data_origin, "
                     "tool_version, tolerance_MPa, tolerance_from, worst_case_MPa, refinement and "
                     "others to the root, and Conventions, title, source and comment of CF"}};
  out.items = {
      {"value", "numbers, row-major in the order of the axes, finite; any HDF5 storage"},
      {"value: quantity", "mu or tau_R: what is tabulated"},
      {"value: transform", "linear, or log where it is interpolated in ln; log needs the schema"},
      {"value: interpolation",
       "linear (in the axes' coordinates), or cubic (then `spline` is not-a-knot)"},
      {"value: combine",
       "tau_R_MPa as a Python expression of `value`, canonical states (explain sigma_n_MPa) and "
       "constants, with minimum, maximum, exp, log, sqrt, sin, tanh, arccos, where",
       {{"example", "minimum(value*sigma_n_MPa, m*0.577*sigma_f_MPa)"}}},
      {"value: NAME", "one number attribute per constant of combine"},
      {"AXIS", "ascending nodes, at least 2; a dimension scale of `value`, named like a quantity"},
      {"AXIS: units", "the canonical unit of that quantity, 1 for a number"},
      {"AXIS: transform", "linear, or log where it is interpolated in ln"},
      {"AXIS: kinks", "optional, cubic only: nodes at which the spline bends, in one text"},
      {"AXIS: outside_low, outside_high",
       "optional, what a query beyond that end gets: clamp (as without), error or law"},
      {"AXIS: data_low, data_high",
       "optional: what the data reach on which the law was calibrated"},
      {"ln_AXIS",
       "written for readers of netCDF: the logarithm of a log axis, in which interpolation is "
       "right"},
      {"AXIS: share_beyond_data",
       "written for readers: share of the nodes that lie beyond them, 0 to 1"},
      {"distance",
       "written for readers: radius around each node that holds half a test's worth of rows; 1 is "
       "what the data span of one axis"},
      {"/: share_far", "optional: share of the range, 0 to 1, with a distance above 0.25"},
      {"value: extension",
       "where a side says law: the law's own `value` (never its ln) as an expression of the axes "
       "and constants; a long one goes on in extension_2, extension_3, ..."},
      {"/: range_low_STATE, range_high_STATE",
       "range of a state of combine that is not an axis, for verify; a name that is not a "
       "canonical state is an input only where these are there"},
      {"/: units_STATE, long_name_STATE, levels_STATE",
       "optional: of such an input; levels: 0 = A, 1 = B of a text column"},
      {"/: schema",
       "frictab/table/2; of /1 are files whose `value` holds ln where transform is log"},
      {"/: model", "optional: a name of letters, digits, '_', '.', '-'"}};
  return out;
}

// Returns the path of the rule: "table.axes.*.nodes" for "table.axes.psi.nodes".
std::string rule_path(const std::string& path) {
  std::string out;
  for (const std::string& key : pieces(path, '.')) {
    const job::SectionRule* section = job::find_section(out);
    const std::vector<std::string> names =
        section && section->children ? section->children() : std::vector<std::string>();
    const bool by_name = std::ranges::find(names, key) != names.end();
    out += (out.empty() ? "" : ".") + (by_name ? std::string("*") : key);
  }
  return out;
}

// Explains the key, or all keys, with that last part: "tolerance_MPa".
std::optional<Explanation> about_last_part(const std::string& name) {
  Explanation all{name, "job keys", "keys of the job file that end so", {}, "keys", {}};
  for (const job::KeyRule& rule : job::key_rules())
    if (job::last_part(rule.path) == name)
      all.items.push_back({rule.path, rule.meaning, key_fields(rule)});
  if (all.items.empty()) return std::nullopt;
  if (all.items.size() == 1) return about(*job::find_key(all.items.front().name));
  return all;
}

Explanation about(const job::System& system) {
  Explanation out{system.name, "tribosystem", system.title, {}, "parameters"};
  const auto add = [&](const char* label, const std::string& text) {
    if (!text.empty()) out.fields.emplace_back(label, text);
  };
  add("pair", system.pair);
  add("lubricant", system.lubricant);
  add("law", system.law);
  add("tests", std::to_string(system.tests));
  add("error", system.error);
  for (const auto& [state, range] : system.range)
    add("tested", fmt::format("{} {} to {}", state, shortest(range.first), shortest(range.second)));
  add("caution", system.caution);
  add("source", system.source);
  add("licence", system.licence);
  add("made by", system.made);
  add("use", "frictab export --system " + system.name + " -o DIR --targets c,abaqus_vfric");
  for (const job::System::Constant& one : system.parameters) {
    Item item{one.name, "", {{"value", shortest(one.value)}}};
    if (one.std_error > 0) item.fields.emplace_back("standard error", shortest(one.std_error));
    out.items.push_back(std::move(item));
  }
  return out;
}

} // namespace

Explanation explain_law(const models::Law& law) {
  return about(law);
}

std::optional<Explanation> explain(const std::string& name) {
  if (const models::Law* law = job::literature().find(name)) return about(*law);
  if (const effects::EffectForm* effect = effects::find_effect(name)) return about(*effect);
  if (const codegen::Exporter* target = codegen::find_exporter(name)) return about(*target);
  if (const data::Quantity* quantity = data::find_quantity(name)) return about(*quantity);
  if (name == "job")
    return about_section("", "the job file (TOML): every key, all optional but data.training; '*' "
                             "stands for a name: of a quantity, an option or a target");
  if (name == "table-layout") return about_table_layout();
  for (const job::System& system : job::systems())
    if (system.name == name) return about(system);
  if (auto topic = explain_topic(name)) return topic;
  const std::string path = rule_path(name);
  if (const job::KeyRule* key = job::find_key(path)) return about(*key);
  if (const job::SectionRule* section = job::find_section(path))
    return path == "process" ? about_process(section->meaning)
                             : about_section(path, section->meaning);
  return about_last_part(name);
}

std::vector<std::string> explainable() {
  std::vector<std::string> names = job::literature().names();
  const auto add = [&](const std::vector<std::string>& more) {
    names.insert(names.end(), more.begin(), more.end());
  };
  add(effects::effect_names());
  add(all_names(codegen::all_exporters(), &codegen::Exporter::name));
  add(all_names(data::quantities(), &data::Quantity::name));
  add({"job", "table-layout"});
  add(all_names(job::systems(), &job::System::name));
  add(topic_names());
  add(all_names(job::section_rules(), &job::SectionRule::path));
  for (const job::KeyRule& key : job::key_rules()) {
    names.push_back(key.path);
    if (job::last_part(key.path) != "*") names.push_back(job::last_part(key.path));
  }
  return names;
}

} // namespace frictab::cli
