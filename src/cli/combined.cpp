// Combines tables of several laws in one user file, and reads the recipes of such files.
#include "cli/combined.h"

#include <algorithm>
#include <deque>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/sources.h"
#include "codegen/combine.h"
#include "codegen/recipe.h"
#include "codegen/values_file.h"
#include "core/error.h"
#include "core/text.h"
#include "core/text_table.h"
#include "io/atomic_file.h"
#include "io/file_streams.h"
#include "io/json.h"
#include "job/job.h"
#include "table/table_file.h"
#include "verify/combined.h"
#include "verify/compare_text.h"
#include "verify/options.h"

namespace frictab::cli {

namespace {

namespace fs = std::filesystem;

using json = nlohmann::ordered_json;

struct NamedTables {
  std::vector<std::string> names;
  std::vector<fs::path> files;
  std::deque<table::Table> tables; // requests refer to them
};

NamedTables named_files(const std::vector<std::string>& laws) {
  NamedTables out;
  for (const std::string& law : laws) {
    const std::size_t equals = law.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == law.size())
      throw InputError({}, "--combine takes NAME=TABLE, not '" + law + "'",
                       "for example --combine PUNCH=out/tables/coulomb.h5 DIE=out/tables/shear.h5");
    out.names.push_back(law.substr(0, equals));
    out.files.emplace_back(law.substr(equals + 1));
  }
  return out;
}

// Returns the options that apply to all laws.
codegen::ExportOptions export_options(const ExportArguments& arguments,
                                      const CommonOptions& common) {
  if (!arguments.job.empty()) {
    const codegen::ExportOptions of_job = job::read_job(arguments.job, common.set).exports;
    if (of_job.form == codegen::ExportForm::direct)
      throw InputError({arguments.job, 0, 0},
                       "--combine writes tables, and the job asks for the direct form",
                       "--set export.form=table");
    return of_job;
  }
  codegen::ExportOptions out;
  out.targets = arguments.targets;
  out.units = arguments.units;
  out.temperature = arguments.temperature;
  return out;
}

// Selects the targets that have an entry for several laws. Notes the others; throws InputError if
// none remains.
std::vector<const codegen::Exporter*> combining(const std::vector<std::string>& names,
                                                const CommonOptions& common) {
  std::vector<const codegen::Exporter*> out;
  std::vector<std::string> left_out;
  for (const codegen::Exporter* exporter : codegen::exporters_named(names))
    if (exporter->combines())
      out.push_back(exporter);
    else
      left_out.push_back(exporter->name + " has no routine to combine: " +
                         (exporter->is_routine() ? exporter->several_laws
                                                 : "the solver's own tables are one per contact"));
  if (out.empty()) throw InputError({}, join(left_out, "; "), "for example --targets abaqus_vfric");
  for (const std::string& line : left_out)
    note(common, "left out: " + line);
  return out;
}

std::vector<codegen::ExportRequest> requests(const NamedTables& laws,
                                             const codegen::ExportOptions& options,
                                             const std::string& target) {
  std::vector<codegen::ExportRequest> out;
  for (const table::Table& table : laws.tables)
    out.push_back({table, options.solver_units(), options.inputs_for(target), options.options});
  return out;
}

// Adds the paths of the tables, relative to the recipe's directory, from which verify_combined()
// reads them.
std::string with_tables(const std::string& recipe, const NamedTables& laws,
                        const fs::path& directory) {
  json out = io::parse_json(recipe, "recipe.json");
  for (std::size_t i = 0; i < laws.files.size(); ++i)
    out["laws"][i]["table_file"] =
        fs::proximate(fs::absolute(laws.files[i]), fs::absolute(directory)).generic_string();
  return io::json_text(out);
}

void write(io::OutputFiles& output, const codegen::Exporter& exporter, const NamedTables& laws,
           const codegen::ExportOptions& options, const fs::path& directory) {
  const codegen::CombinedBundle bundle = codegen::faults_of_law(exporter.name, [&] {
    return exporter.combine(requests(laws, options, exporter.name), laws.names);
  });
  for (const auto& [path, text] : bundle.files)
    output.write(exporter.name + "/" + path,
                 path == "recipe.json" ? with_tables(text, laws, directory / exporter.name) : text);
}

// ---- verify ----

// A recipe that `export --combine` wrote, and the inputs from which it was made.
struct Combined {
  const codegen::Exporter* exporter = nullptr;
  codegen::SourceBundle files;
  NamedTables laws;
  codegen::ExportOptions options;
};

void read_recipe(Combined& out, const fs::path& file) {
  const json recipe = io::parse_json(io::read_file(file), file.string());
  io::read_json(file.string(), "export again", [&] {
    out.exporter = codegen::find_exporter(recipe.at("target").get<std::string>());
    out.options.units = recipe.at("units").at("system");
    out.options.temperature = recipe.at("units").at("temperature");
    for (const json& law : recipe.at("laws")) {
      out.laws.names.push_back(law.at("name"));
      out.laws.files.push_back(file.parent_path() / law.at("table_file").get<std::string>());
      out.options.inputs = law.at("export").at("inputs").get<decltype(out.options.inputs)>();
      out.options.options = law.at("export").at("options").get<decltype(out.options.options)>();
    }
  });
  if (!out.exporter || !out.exporter->combines())
    throw InputError({file.string(), 0, 0}, "this frictab has no such target", "export again");
}

Combined read_combined(const fs::path& recipe) {
  Combined out;
  read_recipe(out, recipe);
  for (const std::string& name : codegen::files_of_recipe(io::read_file(recipe), recipe.string()))
    out.files[name] = io::read_file(recipe.parent_path() / name);
  for (const fs::path& file : out.laws.files)
    out.laws.tables.push_back(table::read_table(file.string()));
  return out;
}

std::vector<fs::path> combined_recipes(const std::string& directory) {
  std::vector<fs::path> recipes;
  for (const codegen::Exporter& exporter : codegen::all_exporters()) {
    const fs::path file = fs::path(directory) / exporter.name / "recipe.json";
    if (!fs::exists(file)) continue;
    const json recipe = io::parse_json(io::read_file(file), file.string());
    if (recipe.is_object() && recipe.value("schema", json("")) == codegen::combined_schema)
      recipes.push_back(file);
  }
  if (recipes.empty())
    throw InputError({directory, 0, 0}, "there are no combined sources",
                     "name the directory that `frictab export --combine ... -o DIR` wrote");
  return recipes;
}

} // namespace

int export_combined(const ExportArguments& arguments, const CommonOptions& common) {
  need_directory(common, "--combine");
  NamedTables laws = named_files(arguments.combine);
  const codegen::ExportOptions options = export_options(arguments, common);
  const auto exporters = combining(options.targets, common);
  for (const fs::path& file : laws.files)
    codegen::check_request_size(table::read_description(file.string()).table, exporters,
                                options.options);
  for (const fs::path& file : laws.files)
    laws.tables.push_back(table::read_table(file.string()));
  io::OutputFiles output(common.output);
  for (const codegen::Exporter* exporter : exporters)
    write(output, *exporter, laws, options, common.output);
  commit_and_list(output, common);
  note(common, "frictab verify --combined " + common.output + " proves them");
  return 0;
}

verify::Verification verify_combined(const std::string& directory,
                                     std::optional<double> max_drift_MPa) {
  verify::Verification out;
  out.max_drift_MPa = max_drift_MPa.value_or(0);
  for (const fs::path& recipe : combined_recipes(directory)) {
    const Combined combined = read_combined(recipe);
    codegen::CombinedBundle fresh = combined.exporter->combine(
        requests(combined.laws, combined.options, combined.exporter->name), combined.laws.names);
    std::string& wanted = fresh.files.at("recipe.json");
    wanted = with_tables(wanted, combined.laws, recipe.parent_path());
    for (verify::Finding& finding :
         verify::compare_bundle(combined.files, fresh.files, recipe.parent_path().string())) {
      if (finding.failed) finding.mend = "`frictab export --combine` makes it again";
      out.findings.push_back(std::move(finding));
    }
    const auto records = verify::verify_combined({combined.exporter, {combined.files, fresh.laws}},
                                                 max_drift_MPa, verify::VerifyOptions{}.samples);
    out.records.insert(out.records.end(), records.begin(), records.end());
    if (max_drift_MPa) continue;
    for (const table::Table& table : combined.laws.tables)
      out.max_drift_MPa = std::max(out.max_drift_MPa, table.record.tolerance_MPa.value_or(0.5));
  }
  return out;
}

std::string combined_drift_text(const verify::Verification& verification) {
  std::vector<std::vector<std::string>> rows = {{"law", "routine", "from table", "from law", ""}};
  for (const verify::DriftRecord& r : verification.records)
    rows.push_back(
        r.ran ? std::vector<std::string>{r.model, r.subject,
                                         fmt::format("{:.3g}", r.max_vs_table_MPa),
                                         fmt::format("<= {:.3g}", r.worst_case_MPa),
                                         r.passed ? "ok" : "OVER TOLERANCE"}
              : std::vector<std::string>{r.model, r.subject, "-", "-",
                                         (r.broken ? "BROKEN: " : "not run: ") + r.why_not});
  std::string text =
      "Drift over the whole range, MPa:\n" + text_table(rows, {false, false, true, true});
  for (const verify::Finding& finding : verification.findings)
    text += (finding.failed ? "" : "note: ") + finding.text() +
            (finding.mend.empty() ? "" : "; " + finding.mend) + "\n";
  return text;
}

} // namespace frictab::cli
