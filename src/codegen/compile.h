// Compiles a bundle into a shared library and loads it, to test generated code.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "codegen/exporter.h"
#include "core/os/library.h"
#include "core/program.h"

namespace frictab::codegen {

// Writes bundle and extra files below `work_dir`, runs the variant's command there without a shell
// and returns the library's path. Throws std::runtime_error with the compiler's output if it fails.
std::filesystem::path compile_library(const SourceBundle& bundle, const BuildVariant& variant,
                                      const std::filesystem::path& work_dir);

using os::Library; // loads what compile_library has made

// Passes the directory of the values file to generated code that reads one, through the C function
// `symbol`. Does nothing if the code has no such function.
void pass_directory(const Library& library, const std::filesystem::path& directory,
                    const std::string& symbol = "frictab_directory");

// One bundle of a target, compiled in its own directory and called as its solver would.
class CompiledTarget {
public:
  // Throws std::runtime_error with the compiler's output if it fails, std::system_error if its
  // files cannot be written.
  CompiledTarget(const Exporter& exporter, const ExportRequest& request, const SourceBundle& bundle,
                 const BuildVariant& variant);

  void drive(std::size_t rows, std::span<const double* const> columns,
             std::span<double> tau) const {
    exporter_.drive({handle(), directory_.path(), variant_}, request_, rows, columns, tau);
  }
  std::optional<PathResult> drive_path(const PathOptions& options) const {
    return exporter_.drive_path({handle(), directory_.path(), variant_}, request_, options);
  }
  void* handle() const { return library_ ? library_->handle() : nullptr; }

private:
  const Exporter& exporter_;
  ExportRequest request_;
  BuildVariant variant_;
  TemporaryDirectory directory_;
  std::optional<Library> library_;
};

} // namespace frictab::codegen
