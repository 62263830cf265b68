// Runs compilers and loads the libraries they make.
#include "codegen/compile.h"

#include <stdexcept>

#include "codegen/prefix.h"
#include "core/program.h"
#include "core/text.h"
#include "io/file_streams.h"

namespace frictab::codegen {

namespace {

namespace fs = std::filesystem;

void write_files(const SourceBundle& files, const fs::path& directory) {
  for (const auto& [path, content] : files) {
    fs::create_directories((directory / path).parent_path());
    io::write_file(directory / path, content);
  }
}

} // namespace

fs::path compile_library(const SourceBundle& bundle, const BuildVariant& variant,
                         const fs::path& work_dir) {
  const fs::path directory = fs::absolute(work_dir);
  const fs::path library = directory / ("lib" + variant.name + ".so");
  fs::create_directories(directory);
  write_files(bundle, directory);
  write_files(variant.extra, directory);
  std::vector<std::string> command;
  for (const std::string& word : variant.command)
    command.push_back(
        replace_all(replace_all(word, "@{out}", library.string()), "@{dir}", directory.string()));
  run_program(command, directory);
  return library;
}

void pass_directory(const Library& library, const fs::path& directory, const std::string& symbol) {
  if (void* const tell = Library::address_or_null(library.handle(), symbol))
    reinterpret_cast<void (*)(const char*)>(tell)(directory.c_str());
}

CompiledTarget::CompiledTarget(const Exporter& exporter, const ExportRequest& request,
                               const SourceBundle& bundle, const BuildVariant& variant)
    : exporter_(exporter), request_(request), variant_(variant) {
  if (variant.command.empty()) {
    write_files(bundle, directory_.path());
    return;
  }
  library_.emplace(compile_library(bundle, variant, directory_.path()));
  // The prefix option exists for all targets of a job, but not all of them use it.
  for (const std::string& symbol :
       {std::string("frictab_directory"), prefixed(request, "frictab_directory")})
    pass_directory(*library_, directory_.path(), symbol);
}

} // namespace frictab::codegen
