// A target: the friction routine of one FE code. One folder in exporters/ has the code that fills
// and compiles it; the folder of the same name in templates/ has its text and its driver.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "codegen/path_result.h"
#include "codegen/solver_units.h"
#include "core/registry.h"
#include "table/states.h"
#include "table/table.h"

namespace frictab::codegen {

// Files by path relative to export/<target>/, kept in memory until everything has succeeded.
using SourceBundle = std::map<std::string, std::string>;

struct ExportRequest {
  const table::Table& table;
  SolverUnits units = {};
  // [export.inputs] of the job; checked by the exporter.
  std::map<std::string, std::string> inputs = {};
  // [export.options] of the job; Exporter::option.
  std::map<std::string, std::string> options = {};
  // Name by which the entry of a user file with several laws (codegen/combine.h) knows this law,
  // and the stem of its program units. Empty: the only law.
  std::string law_name = {};
  std::string law_stem = {};

  std::string option_or_empty(const std::string& name) const;
  std::string input_or_empty(const std::string& name) const;
};

// A choice that a target offers in addition to [export.inputs]. Targets that share an option use
// the same name and description.
struct ExportOption {
  std::string name;
  std::vector<std::string> allowed; // the first is the default
  std::string meaning;
  // Returns the fault of a free text, "must be a name"; empty: none. Null: the option takes only
  // the `allowed` values.
  std::string (*fault)(const std::string& text) = nullptr;
};

// One way to make a bundle callable on this machine: compiled to a shared library, run by an
// interpreter, or only read.
struct BuildVariant {
  std::string name; // "c99", "double", "single"
  // Command line (argv); "@{out}" is the library to write, "@{dir}" the bundle; empty: nothing is
  // compiled.
  std::vector<std::string> command;
  SourceBundle extra; // its driver, and stand-ins for files of the solver
  double eps = 0;     // unit roundoff of its real type: the drift due to precision
  // Program that runs code that is not compiled; empty: not needed.
  std::string interpreter = {};

  // The program required on this machine, compiler or interpreter; empty: none.
  const std::string& program() const { return command.empty() ? interpreter : command.front(); }
};

// A bundle that is ready to be called (made by codegen/compile.h).
struct Built {
  void* library;                   // dlopen handle; null if nothing is compiled
  std::filesystem::path directory; // contains the bundle's files
  const BuildVariant& variant;
};

// Several laws in one user file.
struct CombinedBundle {
  SourceBundle files;
  std::vector<ExportRequest> laws; // with their names and stems
};

// Description of a target for lists and `explain`.
struct TargetDescription {
  std::string name = {};
  int order = 0;
  std::string title = {};
  // Source of the argument list: "verified: ..." / "recalled: ..."
  std::string signature_source = {};
  std::string notes = {}; // pitfalls and limits
  std::vector<ExportOption> options = {};
  // Arguments that distinguish the laws; if none can be combined, the reason.
  std::string several_laws = {};
};

class Exporter : public TargetDescription {
public:
  explicit Exporter(TargetDescription description) : TargetDescription(std::move(description)) {}
  virtual ~Exporter() = default;

  // Returns all files including recipe.json. Throws InputError if the request cannot be met.
  virtual SourceBundle generate(const ExportRequest& request) const = 0;
  virtual std::vector<BuildVariant> variants(const ExportRequest& request) const = 0;
  // Calls the routine as its solver would, for rows of states in canonical units (columns in the
  // order of request.table.inputs()), and returns tau_R in MPa. Rows that its arguments cannot
  // represent are left unchanged.
  virtual void drive(const Built& built, const ExportRequest& request, std::size_t rows,
                     std::span<const double* const> columns, std::span<double> tau) const = 0;

  // Drives a routine over increments and compares all that it returns and remembers with an account
  // that is written from the definition of its state variables; nullopt if the target keeps
  // nothing from one increment to the next.
  virtual std::optional<PathResult> drive_path(const Built&, const ExportRequest&,
                                               const PathOptions&) const {
    return std::nullopt;
  }

  // True for a routine that computes the law. Otherwise the target is a solver's own table, which
  // has fewer axes than the law: own_table() returns the table that the solver makes of these
  // files, with the fixed states as numbers.
  virtual bool is_routine() const { return true; }
  virtual table::Table own_table(const ExportRequest& request, const SourceBundle& files) const;
  // Returns the states of request.table.inputs() that these files fix, with their canonical values:
  // those without a column in the solver's own table, and those that the job makes constants.
  virtual table::FixedStates fixed_states(const ExportRequest&) const { return {}; }
  // True if the solver gets a coefficient mu, which it multiplies by the pressure; mu is then at
  // most fortran::largest_coefficient.
  virtual bool gives_mu(const ExportRequest&) const { return false; }
  // Returns the largest difference from the law, in MPa, that these files state: of a target which
  // has no more than the nearest closed form, and so cannot be made to a tolerance. Verification
  // then compares with this figure. Empty: the target follows the law.
  virtual std::optional<double> stated_loss_MPa(const SourceBundle&) const { return std::nullopt; }
  // Returns a warning about these files for the user; empty: none.
  virtual std::string caution(const ExportRequest&) const { return ""; }

  // Calls the target's own entry for many states at once, in the units of the request and without
  // any conversion; for benchmarks. Throws std::logic_error if the target has none.
  virtual bool has_batch() const { return false; }
  virtual void batch(void* library, const ExportRequest& request, std::size_t rows,
                     std::span<const double* const> columns, std::span<double> tau) const;

  // Combines several laws in one user file (codegen/combine.h), with these names. Returns the
  // bundle, and the requests by which a variant of it is built and driven for one of the laws.
  // Throws std::logic_error if the target has no such file.
  virtual bool combines() const { return false; }
  virtual CombinedBundle combine(const std::vector<ExportRequest>& requests,
                                 const std::vector<std::string>& names) const;

  bool offers(std::string_view option) const;

  // Returns the request's choice for one of `options`, or its default.
  const std::string& option(const ExportRequest& request, const std::string& name) const;
};

// `const Registered<ExporterPointer> registered{make_exporter<Fric>};` adds a target.
using ExporterPointer = std::unique_ptr<const Exporter>;
template <class Target> ExporterPointer make_exporter() {
  return std::make_unique<const Target>();
}

// Returns the options of all targets, each once.
std::vector<ExportOption> all_export_options();

std::vector<std::reference_wrapper<const Exporter>> all_exporters();
const Exporter* find_exporter(std::string_view name);

// Returns the named targets, each once, in the order of the registry; "all" stands for all. Throws
// InputError for an unknown name, with the nearest known one.
std::vector<const Exporter*> exporters_named(const std::vector<std::string>& names);

} // namespace frictab::codegen
