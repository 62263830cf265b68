// Writes compile commands.
#include "codegen/source_check.h"

#include <nlohmann/json.hpp>

#include "core/text.h"

namespace frictab::codegen {

using json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

namespace {

bool is_intel(const std::string& compiler) {
  return compiler == "ifort" || compiler == "ifx";
}

bool is_fixed_form(const std::string& source) {
  return source.ends_with(".f");
}

std::string name_on(Platform platform, const std::string& source) {
  return source + (platform == Platform::windows && is_fixed_form(source) ? "or" : "");
}

} // namespace

Words compilers_of(const std::string& source) {
  if (is_fixed_form(source) || source.ends_with(".f90")) return {"gfortran", "ifort", "ifx"};
  return source.ends_with(".c") ? Words{"gcc", "clang"} : Words{};
}

Words compile_flags(const std::string& compiler, const std::string& source, Platform platform) {
  const bool fixed = is_fixed_form(source);
  if (is_intel(compiler) && platform == Platform::windows)
    return {"/O2", fixed ? "/fixed" : "/free", "/fp:precise", "/Qfma-"};
  if (is_intel(compiler))
    return {"-O2", fixed ? "-fixed" : "-free", "-fp-model", "precise", "-no-fma"};
  if (fixed) return {"-O2", "-std=legacy", "-ffixed-line-length-72", "-ffp-contract=off"};
  return {"-O2", source.ends_with(".c") ? "-std=c99" : "-std=f2008", "-ffp-contract=off"};
}

std::string compile_line(const std::string& compiler, const Words& sources, Platform platform) {
  Words words = {compiler, is_intel(compiler) && platform == Platform::windows ? "/c" : "-c"};
  for (const std::string& flag : compile_flags(compiler, sources.front(), platform))
    words.push_back(flag);
  for (const std::string& source : sources)
    words.push_back(name_on(platform, source));
  return join(words, " ");
}

json compile_lines(const Words& sources) {
  json out;
  const bool fixed = is_fixed_form(sources.front());
  for (const auto& [key, platform] :
       {std::pair{"linux", Platform::linux_}, std::pair{"windows", Platform::windows}}) {
    if (fixed && platform == Platform::windows)
      for (const std::string& source : sources)
        out[key]["rename"].push_back("copy " + source + " " + name_on(platform, source));
    for (const std::string& compiler : compilers_of(sources.front()))
      out[key][compiler] = compile_line(compiler, sources, platform);
  }
  std::string note = "tried: gfortran and gcc, for Windows those of MinGW-w64";
  if (!sources.front().ends_with(".c")) note += "; recalled: the flags of ifort and ifx";
  if (fixed)
    note += ", and that Abaqus looks for .for on Windows. Lines end at column 72, so a solver may "
            "also compile them as extended source";
  out["note"] = note;
  return out;
}

} // namespace frictab::codegen
