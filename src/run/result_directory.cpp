// Finds and reads the files of earlier runs.
#include "run/result_directory.h"

#include <algorithm>

#include "calibrate/calibration_file.h"
#include "codegen/recipe.h"
#include "core/error.h"
#include "core/os/files.h"
#include "io/atomic_file.h"
#include "io/file_streams.h"
#include "models/law.h"
#include "table/table_file.h"
#include "trace/trace_file.h"
#include "verify/verify.h"

namespace frictab::run {

namespace fs = std::filesystem;

namespace {

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

// Adds the stems of files named like a model: no registry has the names of laws with traced effects
// or at the ends of bands.
void add_model_names(std::vector<std::string>& names, const fs::path& directory,
                     const models::Laws& laws) {
  for (const fs::path& path : os::entries_of(directory))
    if (const std::string name = path.stem().string(); models::read_model_name(name, laws).base)
      add_once(names, name);
}

} // namespace

ResultDirectory::ResultDirectory(const job::Job& job)
    : directory_(job.directory), job_(job.file), laws_(job.models.laws) {
  io::finish_interrupted(directory_);
}

ResultDirectory::ResultDirectory(const job::Job& job, fs::path directory)
    : directory_(std::move(directory)), job_(job.file), laws_(job.models.laws) {}

std::vector<std::string> ResultDirectory::all_files() const {
  std::vector<std::string> files;
  if (!fs::exists(directory_)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(directory_))
    if (entry.is_regular_file())
      files.push_back(entry.path().lexically_relative(directory_).string());
  std::ranges::sort(files);
  return files;
}

calibrate::Calibration ResultDirectory::calibration() const {
  const fs::path file = directory_ / "calibration.json";
  if (!fs::exists(file))
    throw InputError({file.string(), 0, 0}, "there is no calibration yet",
                     "run `frictab calibrate " + job_ + "` first");
  return calibrate::parse_calibration(io::read_file(file), file.string());
}

std::vector<fs::path> ResultDirectory::table_paths() const {
  std::vector<fs::path> files = os::entries_of(directory_ / "tables");
  std::erase_if(files, [](const fs::path& path) {
    return path.extension() != ".h5" || path.filename().string().front() == '.';
  });
  return files;
}

bool ResultDirectory::has_calibration() const {
  return fs::exists(directory_ / "calibration.json");
}

bool ResultDirectory::has_tables() const {
  return !table_paths().empty();
}

std::vector<fs::path> ResultDirectory::all_tables() const {
  std::vector<fs::path> files = table_paths();
  if (files.empty())
    throw InputError({(directory_ / "tables").string(), 0, 0}, "there are no tables yet",
                     "run `frictab tabulate " + job_ + "` first");
  return files;
}

// Checks that the file has the name of its table's model, because all stages find tables by file
// name.
static void check_model(const table::Table& table, const fs::path& file) {
  if (table.model == file.stem()) return;
  throw InputError({file.string(), 0, 0}, "holds a table of '" + table.model + "'",
                   "tabulate again; a table from elsewhere is for `frictab export --table`");
}

std::vector<table::Table> ResultDirectory::tables() const {
  std::vector<table::Table> tables;
  for (const fs::path& file : all_tables()) {
    tables.push_back(table::read_table(file));
    check_model(tables.back(), file);
  }
  return tables;
}

std::string ResultDirectory::source_directory(const std::string& target,
                                              const std::string& model) const {
  const std::string all = "export/" + target, own = all + "/" + model;
  const fs::path recipe = directory_ / all / "recipe.json";
  if (fs::exists(directory_ / own) || !fs::exists(recipe)) return own;
  return codegen::model_of_recipe(io::read_file(recipe.string()), recipe.string()) == model ? all
                                                                                            : own;
}

codegen::SourceBundle ResultDirectory::sources(const std::string& name) const {
  const fs::path directory = directory_ / name;
  if (!fs::is_directory(directory))
    throw InputError({directory.string(), 0, 0}, "there are no generated sources",
                     "run `frictab export " + job_ + "` first");
  const std::string recipe = (directory / "recipe.json").string();
  codegen::SourceBundle bundle = {{"recipe.json", io::read_file(recipe)}};
  for (const std::string& file : codegen::files_of_recipe(bundle.at("recipe.json"), recipe))
    bundle[file] = io::read_file(directory / file);
  return bundle;
}

std::vector<trace::Trace> ResultDirectory::traces() const {
  const fs::path file = directory_ / "trace.json";
  if (!fs::exists(file)) return {};
  return trace::parse_traces(io::read_file(file), file.string());
}

std::optional<verify::Verification> ResultDirectory::verification() const {
  const fs::path file = directory_ / "verify.json";
  if (!fs::exists(file)) return std::nullopt;
  return verify::parse_verification(io::read_file(file), file.string());
}

std::vector<std::string> ResultDirectory::model_files() const {
  std::vector<std::string> names = laws_.names(), files;
  add_model_names(names, directory_ / "models", laws_);
  for (const std::string& name : names)
    files.push_back("models/" + name + ".json");
  return files;
}

std::vector<std::string> ResultDirectory::table_names() const {
  std::vector<std::string> names = laws_.names();
  add_model_names(names, directory_ / "tables", laws_);
  for (const codegen::Exporter& exporter : codegen::all_exporters())
    add_model_names(names, directory_ / "export" / exporter.name, laws_);
  return names;
}

std::vector<std::string> ResultDirectory::table_files() const {
  std::vector<std::string> files;
  for (const std::string& name : table_names())
    files.push_back("tables/" + name + ".h5");
  return files;
}

std::vector<std::string> ResultDirectory::source_files() const {
  const std::vector<std::string> tables = table_names();
  std::vector<std::string> directories, files;
  for (const codegen::Exporter& exporter : codegen::all_exporters()) {
    directories.push_back("export/" + exporter.name);
    for (const std::string& name : tables)
      directories.push_back("export/" + exporter.name + "/" + name);
  }
  for (const std::string& directory : directories) {
    const fs::path recipe = directory_ / directory / "recipe.json";
    if (!fs::exists(recipe)) continue;
    for (const std::string& file : codegen::files_of_recipe(io::read_file(recipe), recipe.string()))
      files.push_back(directory + "/" + file);
  }
  return files;
}

} // namespace frictab::run
