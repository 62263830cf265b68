// Compiles generated sources for tests and keeps the libraries loaded.
#include "support/generated.h"

#include <filesystem>
#include <fstream>
#include <map>

#include <fenv.h>
#include <fmt/format.h>
#include <unistd.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "codegen/values_file.h"
#include "core/text.h"
#include "support/run_command.h"
#include "support/sample_tables.h"

namespace frictab::test {

using codegen::BuildVariant;
using codegen::Library;
using codegen::SourceBundle;

namespace fs = std::filesystem;

namespace {

// ctest runs every suite as a process of its own: what one has compiled lies beside the tests for
// the others, by its text and its compiler's command.
fs::path kept_library(const SourceBundle& bundle, const BuildVariant& build) {
  std::string all = join(build.command, "\n");
  for (const SourceBundle* files : {&bundle, &build.extra})
    for (const auto& [path, text] : *files)
      all += "\n" + path + "\n" + text;
  const std::string name = fmt::format("{:016x}.so", XXH3_64bits(all.data(), all.size()));
  return fs::path(test::program()).parent_path() / "tests" / "compiled" / name;
}

// A file of values lies in a directory of the library's name.
void keep_values(const SourceBundle& bundle, const fs::path& directory) {
  const auto values = bundle.find(codegen::values_file_name);
  if (values == bundle.end() || fs::exists(directory / codegen::values_file_name)) return;
  fs::create_directories(directory);
  const fs::path own = directory / std::to_string(getpid());
  std::ofstream(own, std::ios::binary) << values->second;
  fs::rename(own, directory / codegen::values_file_name);
}

std::vector<std::string> both(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

BuildVariant variant_of(const codegen::Exporter& exporter, const codegen::ExportRequest& request,
                        const std::string& name, const std::vector<std::string>& flags) {
  for (BuildVariant& build : exporter.variants(request)) {
    if (build.name != name) continue;
    add_flags(build, flags);
    return build;
  }
  throw std::logic_error("no variant " + exporter.name + "/" + name);
}

std::unique_ptr<Library> library_of(const SourceBundle& bundle, const BuildVariant& build) {
  const fs::path kept = kept_library(bundle, build);
  keep_values(bundle, fs::path(kept).replace_extension());
  if (!fs::exists(kept)) {
    const TemporaryDirectory work;
    const fs::path made = codegen::compile_library(bundle, build, work.path());
    const fs::path own = kept.string() + "." + std::to_string(getpid());
    fs::create_directories(kept.parent_path());
    fs::copy_file(made, own);
    fs::rename(own, kept); // whole or not at all, whoever else makes it
  }
  auto library = std::make_unique<Library>(kept);
  codegen::pass_directory(*library, fs::path(kept).replace_extension());
  return library;
}

} // namespace

const std::vector<std::string> strict = both(no_warnings, run_checks);
const std::vector<std::string> strict_declared = both(strict, {"-fimplicit-none"});

bool stands_for_its_language(const codegen::Exporter& exporter) {
  for (const char* name : {"c", "fortran", "abaqus_vfric", "qform_lua"})
    if (exporter.name == name) return true;
  return false;
}

bool has_a_core_of_its_own(const codegen::Exporter& exporter) {
  return stands_for_its_language(exporter) || exporter.name == "abaqus_fric";
}

void add_flags(BuildVariant& variant, const std::vector<std::string>& flags) {
  variant.command.insert(variant.command.begin() + 1, flags.begin(), flags.end());
}

const Library* compiled(const std::string& key, const codegen::Exporter& exporter,
                        const codegen::ExportRequest& request, const std::string& variant,
                        const std::vector<std::string>& flags) {
  static std::map<std::string, std::unique_ptr<Library>> libraries;
  const std::string name = exporter.name + "/" + variant + "/" + key;
  if (const auto found = libraries.find(name); found != libraries.end()) return found->second.get();
  const BuildVariant build = variant_of(exporter, request, variant, flags);
  if (!have_program(build.command[0])) return nullptr;
  return libraries.emplace(name, library_of(exporter.generate(request), build)).first->second.get();
}

double worst_driven(const codegen::Exporter& exporter, const codegen::ExportRequest& request,
                    const std::string& variant, const std::vector<std::string>& flags,
                    const std::map<std::string, double>& fixed) {
  const States states(request.table, 20000, 11, 0.1, fixed);
  std::vector<double> tau(states.rows(), -1);
  codegen::CompiledTarget(exporter, request, exporter.generate(request),
                          variant_of(exporter, request, variant, flags))
      .drive(tau.size(), states.columns(), tau);
  return worst_relative(tau, expected(request.table, states));
}

FloatTraps::FloatTraps() {
  feclearexcept(FE_ALL_EXCEPT);
  feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
}

FloatTraps::~FloatTraps() {
  fedisableexcept(FE_ALL_EXCEPT);
  feclearexcept(FE_ALL_EXCEPT);
}

} // namespace frictab::test
