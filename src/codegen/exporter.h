// A target: one FE code's friction routine. How it is filled and compiled is one folder in
// exporters/; what it looks like, and how it is called, the folder of the same name in templates/.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
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

  // What the job says for an option; empty: nothing.
  std::string said(const std::string& option) const {
    const auto found = options.find(option);
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

struct Exporter {
  std::string name = {};
  int order = 0;
  std::string title = {};
  // Where the argument list comes from: "verified: ..." / "recalled: ..."
  std::string signature_source = {};
  std::string notes = {}; // traps and limits, for `explain`
  std::vector<ExportOption> options = {};

  // All files with recipe.json. Throws InputError where the request cannot be met.
  std::function<SourceBundle(const ExportRequest&)> generate = {};
  std::function<std::vector<BuildVariant>(const ExportRequest&)> variants = {};
  // Calls the routine as its solver would, for rows of states in canonical units (columns in the
  // order of request.table.inputs()), and gives tau_R in MPa; rows it cannot pose stay as they are.
  std::function<void(const Built&, const ExportRequest&, std::size_t rows,
                     std::span<const double* const> columns, std::span<double> tau)>
      drive = {};
  // A solver's own table, which has fewer axes than the law, instead of a routine: what the solver
  // makes of these files, with the states that it holds as numbers. Null: a routine.
  std::function<table::Table(const ExportRequest&, const SourceBundle&)> own_table = {};
  // The states of request.table.inputs() that these files hold, at which values (canonical): those
  // that the solver's own table has no column for; those that the job says are constants. Null:
  // none ever.
  std::function<table::HeldStates(const ExportRequest&)> held = {};
  // Whether the solver gets a coefficient mu and multiplies it by the pressure: at most
  // fortran::largest_coefficient then. Null: never.
  std::function<bool(const ExportRequest&)> gives_mu = {};
  // What a user has to know of these files before taking them; empty: nothing. Null: never.
  std::function<std::string(const ExportRequest&)> caution = {};
  // Its own entry for many states at once, in the units of the request and without any conversion:
  // what a benchmark calls. Null where the target has none.
  void (*batch)(void* library, const ExportRequest&, std::size_t rows,
                std::span<const double* const> columns, std::span<double> tau) = nullptr;

  // Several laws in one user file (codegen/combine.h), for requests with these names: the bundle,
  // and the requests by which a variant of it is built and driven for one of the laws. Null: the
  // target has no such file.
  std::function<CombinedBundle(const std::vector<ExportRequest>&,
                               const std::vector<std::string>& names)>
      combine = {};
  std::string several_laws = {}; // what tells them apart; where nothing is combined, why

  // A routine, which is the law's; not so a table of the solver's, made from the law for it.
  bool whole() const { return !own_table; }

  bool offers(std::string_view option) const;

  // What the request says for one of `options`, or its default.
  const std::string& option(const ExportRequest& request, const std::string& name) const;
};

// Those of all targets, each once.
std::vector<ExportOption> all_export_options();

const std::vector<Exporter>& all_exporters();
const Exporter* find_exporter(std::string_view name);

// Each once, in the order of the registry; "all" stands for all. Throws InputError for a name that
// is none, naming the nearest.
std::vector<const Exporter*> exporters_named(const std::vector<std::string>& names);

} // namespace frictab::codegen
