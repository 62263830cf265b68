// A target: one FE code's friction routine. How it is filled and compiled is one folder in
// exporters/; what it looks like, and how it is called, the folder of the same name in templates/.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/registry.h"
#include "table/states.h"
#include "table/table.h"

namespace frictab::codegen {

// Files by path relative to export/<target>/, in memory until everything succeeded.
using SourceBundle = std::map<std::string, std::string>;

struct ExportRequest {
  const table::Table& table;
  std::string units = "mm-t-s"; // mm-t-s: MPa, mm/s, mm, N | m-kg-s: Pa, m/s, m, N
  std::map<std::string, std::string> inputs = {};  // job's [export.inputs]; checked by the exporter
  std::map<std::string, std::string> options = {}; // job's [export.options]; Exporter::option
  // One of several laws of a user file (codegen/combine.h): the name by which its entry knows this
  // one, and what names of its program units start with. Empty: the only law.
  std::string law_name = {};
  std::string law_stem = {};

  std::string option_or_empty(const std::string& name) const {
    const auto found = options.find(name);
    return found == options.end() ? "" : found->second;
  }
};

// A choice that a target offers beyond [export.inputs]. Targets may share one: same name, same
// words.
struct ExportOption {
  std::string name;
  std::vector<std::string> allowed; // the first is the default
  std::string meaning;
  // Of an option of any text: what is wrong with one, "must be a name"; empty: nothing. Null: the
  // allowed ones are all.
  std::string (*fault)(const std::string& text) = nullptr;
};

// One way to make a bundle ready to be driven here: compiled to a shared library, or run by an
// interpreter, or only read.
struct BuildVariant {
  std::string name;                 // "c99", "double", "single"
  std::vector<std::string> command; // argv; "@{out}" is the library to write, "@{dir}" the bundle;
                                    // empty: nothing is compiled
  SourceBundle extra;               // its driver, stand-ins for files of the solver
  double eps = 0; // unit roundoff of its real type: the drift that precision alone explains
  std::string interpreter = {}; // the program that runs what is not compiled; empty: none is needed

  // What has to be on this machine: the compiler or the interpreter; empty: nothing.
  const std::string& program() const { return command.empty() ? interpreter : command.front(); }
};

// A bundle as it lies ready to be called (codegen/compile.h makes one).
struct Built {
  void* library;                   // dlopen handle; null where nothing is compiled
  std::filesystem::path directory; // holds the bundle's files
  const BuildVariant& variant;
};

// Several laws in one user file.
struct CombinedBundle {
  SourceBundle files;
  std::vector<ExportRequest> laws; // with names and numbers
};

// What lists and `explain` show of a target.
struct TargetDescription {
  std::string name = {};
  int order = 0;
  std::string title = {};
  // Where the argument list comes from: "verified: ..." / "recalled: ..."
  std::string signature_source = {};
  std::string notes = {}; // traps and limits
  std::vector<ExportOption> options = {};
  std::string several_laws = {}; // what tells them apart; where nothing is combined, why
};

class Exporter : public TargetDescription {
public:
  explicit Exporter(TargetDescription description) : TargetDescription(std::move(description)) {}
  virtual ~Exporter() = default;

  // All files with recipe.json. Throws InputError where the request cannot be met.
  virtual SourceBundle generate(const ExportRequest& request) const = 0;
  virtual std::vector<BuildVariant> variants(const ExportRequest& request) const = 0;
  // Calls the routine as its solver would, for rows of states in canonical units (columns in the
  // order of request.table.inputs()), and gives tau_R in MPa; rows that its arguments cannot
  // represent are left unchanged.
  virtual void drive(const Built& built, const ExportRequest& request, std::size_t rows,
                     std::span<const double* const> columns, std::span<double> tau) const = 0;

  // A routine computes the law; otherwise the target is a solver's own table, which has fewer axes
  // than the law: own_table() is what the solver makes of these files, with the states that it
  // holds as numbers.
  virtual bool is_routine() const { return true; }
  virtual table::Table own_table(const ExportRequest& request, const SourceBundle& files) const;
  // The states of request.table.inputs() that these files hold, at which values (canonical): those
  // that the solver's own table has no column for; those that the job fixes as constants.
  virtual table::HeldStates held(const ExportRequest&) const { return {}; }
  // Whether the solver gets a coefficient mu and multiplies it by the pressure: at most
  // fortran::largest_coefficient then.
  virtual bool gives_mu(const ExportRequest&) const { return false; }
  // What a user has to know of these files before taking them; empty: nothing.
  virtual std::string caution(const ExportRequest&) const { return ""; }

  // Its own entry for many states at once, in the units of the request and without any conversion:
  // what a benchmark calls. Throws std::logic_error where the target has none.
  virtual bool has_batch() const { return false; }
  virtual void batch(void* library, const ExportRequest& request, std::size_t rows,
                     std::span<const double* const> columns, std::span<double> tau) const;

  // Several laws in one user file (codegen/combine.h), for requests with these names: the bundle,
  // and the requests by which a variant of it is built and driven for one of the laws. Throws
  // std::logic_error where the target has no such file.
  virtual bool combines() const { return false; }
  virtual CombinedBundle combine(const std::vector<ExportRequest>& requests,
                                 const std::vector<std::string>& names) const;

  bool offers(std::string_view option) const;

  // What the request says for one of `options`, or its default.
  const std::string& option(const ExportRequest& request, const std::string& name) const;
};

// `const Registered<ExporterPointer> registered{make_exporter<Fric>};` adds a target.
using ExporterPointer = std::unique_ptr<const Exporter>;
template <class Target> ExporterPointer make_exporter() {
  return std::make_unique<const Target>();
}

// Those of all targets, each once.
std::vector<ExportOption> all_export_options();

std::vector<std::reference_wrapper<const Exporter>> all_exporters();
const Exporter* find_exporter(std::string_view name);

// Each once, in the order of the registry; "all" stands for all. Throws InputError for a name that
// is none, naming the nearest.
std::vector<const Exporter*> exporters_named(const std::vector<std::string>& names);

} // namespace frictab::codegen
