// frictab export --check: compiles exported sources on their own, with stand-ins for what their
// solver includes.
#pragma once

#include <filesystem>

namespace frictab::cli {

// Compiles the sources of every recipe.json below a directory with the first compiler that is
// installed, and prints one line per source. Returns 1 if one does not compile. Throws InputError
// if there is nothing to compile, or a compiler is missing.
int check_sources(const std::filesystem::path& directory);

} // namespace frictab::cli
