// Makes a model from constants, a table from the model, and routines from the table.
#include "cli/law_alone.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "calibrate/calibration_file.h"
#include "calibrate/slip_distance.h"
#include "cli/sources.h"
#include "codegen/exporter.h"
#include "core/error.h"
#include "core/no_value.h"
#include "core/text.h"
#include "core/version.h"
#include "data/meaning.h"
#include "data/quantity.h"
#include "io/number.h"
#include "job/literature.h"
#include "job/systems.h"
#include "table/build.h"
#include "table/table_file.h"
#include "verify/verify.h"
#include "words/drift.h"
#include "words/render.h"

namespace frictab::cli {

namespace {

constexpr const char* flow_stress = "sigma_f_MPa";

// Splits "mu=0.08" into the name and the text after the sign.
std::map<std::string, std::string> assignments(const std::vector<std::string>& words,
                                               const char* option, const char* example) {
  std::map<std::string, std::string> out;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == 0 || equals == word.npos || equals + 1 == word.size())
      throw InputError({}, fmt::format("{} does not take '{}'", option, word),
                       fmt::format("for example {} {}", option, example));
    if (!out.emplace(word.substr(0, equals), word.substr(equals + 1)).second)
      throw InputError({}, fmt::format("{} says {} twice", option, word.substr(0, equals)),
                       "name it once");
  }
  return out;
}

// ---- the law ----

const models::Law& law_of(const std::string& name) {
  const models::Law* law = job::literature().find(name);
  if (!law)
    throw InputError({}, "unknown friction law '" + name + "'",
                     suggest(name, job::literature().names()));
  if (models::is_trained(law->calibrated))
    throw InputError({}, name + " has no constants: it is trained on data", "frictab run JOB");
  return *law;
}

std::string about(const models::Parameter& p) {
  return fmt::format("{}{}, {} to {}", p.meaning, p.unit == "1" ? "" : " in " + p.unit,
                     shortest(p.lower), shortest(p.upper));
}

std::vector<double> parameters_of(const models::Law& law, const std::vector<std::string>& words) {
  const auto given = assignments(words, "--param", "mu=0.08");
  const std::vector<std::string> names = models::parameter_names(law);
  FaultList faults;
  for (const auto& [name, value] : given)
    if (std::ranges::find(names, name) == names.end())
      faults.add({}, fmt::format("{} has no parameter '{}'", law.name, name),
                 names.empty() ? "it has none" : suggest(name, names));
  std::vector<double> out;
  for (const models::Parameter& p : law.parameters) {
    double value = p.start;
    const auto found = given.find(p.name);
    if (found == given.end() && law.calibrated != models::Calibrated::fixed)
      faults.add({}, fmt::format("{} needs --param {}=NUMBER", law.name, p.name), about(p));
    else if (found != given.end() &&
             (!io::read_number(found->second, '.', value) || value < p.lower || value > p.upper))
      faults.add({}, fmt::format("{} = {} is none of its values", p.name, found->second), about(p));
    out.push_back(value);
  }
  faults.throw_if_any();
  return out;
}

// ---- its ranges ----

std::string range_option(const std::string& name, const data::Meaning& meaning) {
  return fmt::format("--range {}=LOW..HIGH{}", name,
                     meaning.unit == "1" ? "" : " in " + meaning.unit);
}

table::StateRange asked_range(const std::string& name, const std::string& text) {
  const data::Meaning meaning = data::meaning_of(name);
  const std::size_t dots = text.find("..");
  double low = 0, high = 0;
  if (dots == text.npos || !io::read_number(std::string_view(text).substr(0, dots), '.', low) ||
      !io::read_number(std::string_view(text).substr(dots + 2), '.', high) || !(low < high) ||
      low < meaning.lowest || (meaning.log_axis && !(low > 0)))
    throw InputError({}, fmt::format("'{}' is not a range of {}", text, name),
                     range_option(name, meaning) + ", with LOW < HIGH" +
                         (meaning.log_axis ? " and above 0" : ""));
  return {name, low, high, "command line"};
}

// The given ranges, otherwise the paper's; a flow stress has no default.
std::vector<table::StateRange> ranges_of(const models::AssembledLaw& law,
                                         const std::map<std::string, std::string>& given) {
  FaultList faults;
  for (const auto& [name, text] : given)
    if (std::ranges::find(law.inputs, name) == law.inputs.end())
      faults.add({}, fmt::format("{} does not take {}", law.model.law->name, name),
                 "it takes " + join(law.inputs, ", "));
  std::vector<table::StateRange> out;
  for (const std::string& name : law.inputs) {
    const data::Quantity* const quantity = data::find_quantity(name);
    if (const auto found = given.find(name); found != given.end())
      out.push_back(asked_range(name, found->second));
    else if (quantity && quantity->paper_range)
      out.push_back({name, quantity->paper_range->first, quantity->paper_range->second, "Table 1"});
    else
      faults.add({}, fmt::format("{} takes {}: over which range?", law.model.law->name, name),
                 range_option(name, data::meaning_of(name)));
  }
  faults.throw_if_any();
  return out;
}

// Makes the model. Without a flow stress it has no shear limit, the same as with data that lack
// one.
models::Model model_of(const ExportArguments& arguments,
                       const std::map<std::string, std::string>& ranges) {
  const models::Law& law = law_of(arguments.law);
  models::Model model;
  model.law = models::shared_law(law);
  model.conventions.shear_limit = ranges.count(flow_stress) > 0;
  model.parameters = parameters_of(law, arguments.parameters);
  if (const auto distance = calibrate::slip_distance(law, model.conventions)) {
    model.law = models::unregistered_law(
        calibrate::at_slip_distance(law, *distance, model.parameters[*distance]));
    model.parameters.erase(model.parameters.begin() + static_cast<std::ptrdiff_t>(*distance));
  }
  return model;
}

std::string model_file(const models::Model& model) {
  calibrate::ModelFit fit;
  fit.model = model;
  fit.std_error.assign(model.parameters.size(), no_value);
  return calibrate::model_json(fit, {});
}

} // namespace

int export_law(const ExportArguments& arguments, const CommonOptions& common) {
  need_directory(common, "--law NAME");
  const auto given = assignments(arguments.ranges, "--range", "sigma_f_MPa=300..900");
  const models::AssembledLaw law(model_of(arguments, given));
  const auto exporters = codegen::exporters_named(arguments.targets);
  const auto ranges = ranges_of(law, given);
  const table::Tolerance allowed = table::auto_tolerance(law, ranges);
  table::TableOptions usual;
  usual.tolerance_MPa = allowed.MPa;
  usual.tolerance_from = allowed.from;
  table::Table table = table::build_table(law, ranges, usual);
  table.record.tool_version = tool_version();
  table.record.data_origin = arguments.origin;
  verify::VerifyInput input{law, table, "the new table", nullptr, allowed.MPa};
  input.allowed_from = allowed.from;
  verify::Verification verification{allowed.MPa, {}};
  verification.records = verify::verify(input, {});
  verify::set_drift(table.record, verification.records.front());
  io::OutputFiles output(common.output);
  table::write_table(table, output.stage(arguments.law + ".h5"), usual.hdf5);
  output.write(arguments.law + ".json", model_file(law.model));
  write_sources(output, exporters, table, {arguments.units, arguments.temperature});
  commit_and_list(output, common);
  show(words::as_text(words::drift(verification, words::Detail::full)));
  return verification.passed() ? 0 : 1;
}

int export_system(const ExportArguments& arguments, const CommonOptions& common) {
  need_directory(common, "--system NAME");
  const job::System system = job::system_named(arguments.system);
  ExportArguments of_law = arguments;
  of_law.law = system.law;
  for (const job::System::Constant& one : system.parameters)
    of_law.parameters.push_back(one.name + "=" + shortest(one.value));
  for (const auto& [state, range] : system.range) {
    const std::string start = state + "=";
    if (std::ranges::none_of(arguments.ranges,
                             [&](const std::string& given) { return given.starts_with(start); }))
      of_law.ranges.push_back(start + shortest(range.first) + ".." + shortest(range.second));
  }
  of_law.origin =
      fmt::format("{}: {} tests; {}; {}", system.name, system.tests, system.source, system.licence);
  if (!system.caution.empty()) note(common, "caution: " + system.caution);
  return export_law(of_law, common);
}

} // namespace frictab::cli
