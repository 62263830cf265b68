// Compiles generated sources for tests and keeps the libraries loaded.
#include "support/generated.h"

#include <map>

#include <fenv.h>

namespace frictab::test {

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
    const TemporaryDirectory work;
    const SourceBundle bundle = exporter.generate(request);
    auto library = std::make_unique<Library>(compile_library(bundle, build, work.path()));
    return libraries.emplace(name, std::move(library)).first->second.get();
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
