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

namespace frictab::test {

namespace fs = std::filesystem;

namespace {

// ctest runs every test as a process of its own: what one has compiled lies beside the tests for
// the others, by its text and its compiler's command.
fs::path kept_library(const SourceBundle& bundle, const BuildVariant& build) {
  std::string all = join(build.command, "\n");
  for (const SourceBundle* files : {&bundle, &build.extra})
    for (const auto& [path, text] : *files)
      all += "\n" + path + "\n" + text;
  const std::string name = fmt::format("{:016x}.so", XXH3_64bits(all.data(), all.size()));
  return fs::path(FRICTAB_BINARY).parent_path() / "tests" / "compiled" / name;
}

// A file of values lies in a directory of the library's name.
void keep_values(const SourceBundle& bundle, const fs::path& directory) {
  const auto values = bundle.find(values_file_name);
  if (values == bundle.end() || fs::exists(directory / values_file_name)) return;
  fs::create_directories(directory);
  const fs::path own = directory / std::to_string(getpid());
  std::ofstream(own, std::ios::binary) << values->second;
  fs::rename(own, directory / values_file_name);
}

std::unique_ptr<Library> library_of(const SourceBundle& bundle, const BuildVariant& build) {
  const fs::path kept = kept_library(bundle, build);
  keep_values(bundle, fs::path(kept).replace_extension());
  if (!fs::exists(kept)) {
    const TemporaryDirectory work;
    const fs::path made = compile_library(bundle, build, work.path());
    const fs::path own = kept.string() + "." + std::to_string(getpid());
    fs::create_directories(kept.parent_path());
    fs::copy_file(made, own);
    fs::rename(own, kept); // whole or not at all, whoever else makes it
  }
  auto library = std::make_unique<Library>(kept);
  library->tell_directory(fs::path(kept).replace_extension());
  return library;
}

} // namespace

const Library* compiled(const std::string& key, const Exporter& exporter,
                        const ExportRequest& request, const std::string& variant,
                        const std::vector<std::string>& flags) {
  static std::map<std::string, std::unique_ptr<Library>> libraries;
  const std::string name = exporter.name + "/" + variant + "/" + key;
  if (const auto found = libraries.find(name); found != libraries.end()) return found->second.get();
  for (BuildVariant build : exporter.variants(request)) {
    if (build.name != variant) continue;
    if (!have_program(build.command[0])) return nullptr;
    build.command.insert(build.command.begin() + 1, flags.begin(), flags.end());
    return libraries.emplace(name, library_of(exporter.generate(request), build))
        .first->second.get();
  }
  throw std::logic_error("no variant " + name);
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
