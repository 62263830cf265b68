// Finds recipes and compiles what they list.
#include "cli/check_sources.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/print.h"
#include "codegen/recipe.h"
#include "codegen/source_check.h"
#include "core/error.h"
#include "core/program.h"
#include "core/text.h"
#include "io/file_streams.h"
#include "io/json.h"

namespace frictab::cli {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> recipes_below(const fs::path& directory) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(directory, error))
    if (entry.path().filename() == "recipe.json") found.push_back(entry.path());
  std::ranges::sort(found);
  if (found.empty())
    throw InputError({directory.string(), 0, 0}, "there are no exported sources",
                     "name the folder that `frictab export` wrote: --check -o out/export");
  return found;
}

// Writes the stand-ins for a solver's includes.
void write_stand_ins(const fs::path& recipe, const fs::path& directory) {
  const nlohmann::ordered_json all = io::parse_json(io::read_file(recipe), recipe.string());
  const auto includes = all.find("stand_ins");
  if (includes == all.end()) return;
  for (const auto& [name, text] : includes->items())
    if (fs::path(name).filename() == name)
      io::write_file(directory / name, text.get<std::string>());
}

class Check {
public:
  void add(const fs::path& recipe) {
    for (const std::string& name :
         codegen::files_of_recipe(io::read_file(recipe), recipe.string())) {
      const std::vector<std::string> compilers = codegen::compilers_of(name);
      if (compilers.empty()) continue;
      const auto compiler = std::ranges::find_if(compilers, have_program);
      if (compiler == compilers.end())
        missing_.insert(join(compilers, ", "));
      else
        compile(recipe, *compiler, name);
    }
  }

  int result(const fs::path& directory) const {
    if (failed_ > 0) return 1;
    if (!missing_.empty())
      throw InputError({},
                       "there is no compiler: " +
                           join(std::vector<std::string>(missing_.begin(), missing_.end()), "; ") +
                           " are not installed",
                       "Debian: apt-get install gfortran gcc");
    if (compiled_ == 0) print_out("{}: nothing to compile\n", directory.string());
    return 0;
  }

private:
  void compile(const fs::path& recipe, const std::string& compiler, const std::string& name) {
    const TemporaryDirectory work;
    const fs::path folder = fs::absolute(recipe).parent_path(); // the compiler runs elsewhere
    const fs::path source = recipe.parent_path() / name;
    io::read_file(source); // throws InputError if it is missing
    write_stand_ins(recipe, work.path());
    std::vector<std::string> command = codegen::compile_flags(compiler, name);
    command.insert(command.begin(), {compiler, "-c"});
    if (name.ends_with(".f90"))
      command.insert(command.end(), {compiler == "gfortran" ? "-J" : "-module", work.path()});
    command.insert(command.end(), {"-I", folder, "-I", work.path(), "-o", work.path() / "checked.o",
                                   folder / name});
    std::string fault;
    try {
      run_program(command, work.path());
      ++compiled_;
    } catch (const std::runtime_error& error) {
      fault = error.what();
      ++failed_;
    }
    show(fmt::format(
        "{}: {} {}\n", source.string(),
        fault.empty() ? "compiled by" : "does not compile:", fault.empty() ? compiler : fault));
  }

  std::size_t compiled_ = 0, failed_ = 0;
  std::set<std::string> missing_;
};

} // namespace

int check_sources(const fs::path& directory) {
  Check check;
  for (const fs::path& recipe : recipes_below(directory))
    check.add(recipe);
  return check.result(directory);
}

} // namespace frictab::cli
