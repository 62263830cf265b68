// Commands that compile generated sources on their own, without their solver: for the recipe and
// README, and for `frictab export --check`.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace frictab::codegen {

enum class Platform { linux_, windows };

// Compilers of sources that end in ".f", ".f90" or ".c", the preferred one first; none for others.
std::vector<std::string> compilers_of(const std::string& source);

// Flags without "-c": the standard, columns, and no fused multiply-add, which would change the last
// bits.
std::vector<std::string> compile_flags(const std::string& compiler, const std::string& source,
                                       Platform platform = Platform::linux_);

// "gfortran -c -O2 ... a.f b.f", for sources of one language. Sources in fixed form end in .for on
// Windows.
std::string compile_line(const std::string& compiler, const std::vector<std::string>& sources,
                         Platform platform = Platform::linux_);

// Returns what to compile by platform and compiler: "linux", "windows" (with "rename"), "note".
nlohmann::ordered_json compile_lines(const std::vector<std::string>& sources);

} // namespace frictab::codegen
