// Several laws in one user file, for different lubricants on punch and die. The file has one entry
// with the solver's own argument list, which calls the law of the contact it is called for. Each
// law's source is the one it has alone, except that its program units are renamed: "ft" is replaced
// by a stem of the law (fttau -> f1tau, f2tau), which is also put before its entry (vfric ->
// f1vfric). A contact without a law ends the analysis.
//
// A solver may want several entries in its one user file (VFRIC for contact pairs, VFRICTION for
// general contact). Their stems differ, so that their sources can follow one another in one file.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/exporter.h"
#include "core/error.h"

namespace frictab::codegen {

// Arguments of an entry that distinguish contacts.
struct LawSelector {
  std::string argument = {}; // "surfInt"; empty: none, so laws cannot be combined
  // "name of the *SURFACE INTERACTION"; without an argument: the reason.
  std::string meaning = {};
  bool number = false;         // true: a number; false: the deck's text, padded with blanks
  std::string alone = {};      // name that drivers pass if there is one law: "FRICTAB"
  std::string guard = {};      // first statements: return from calls without friction
  std::string letters = "fgh"; // stems: f1 to f9, g1 ...; f0 of the entry's own units
  std::string user_file = {};  // entries that may share the user file
  // Replacements in the lines of the input deck if there are several laws: a text with the name
  // ("FRICTAB"), and the text that replaces it, with @ for the law's name.
  std::vector<std::pair<std::string, std::string>> deck = {};
};

// Returns the requests as parts of one file, each with its name and stem. All have the same target,
// options and units. Throws InputError for no or too many laws, a name that this solver cannot
// pass, or equal names (compared without case).
std::vector<ExportRequest> named_laws(std::vector<ExportRequest> laws,
                                      const std::vector<std::string>& names, const LawSelector& by);

// Returns the result of `make`; adds the law's name to faults that it throws: "PUNCH: ...".
template <class Make> auto faults_of_law(const std::string& whose, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    std::vector<Fault> faults = error.faults();
    for (Fault& fault : faults)
      fault.what = whose + ": " + fault.what;
    throw InputError(std::move(faults));
  }
}

// First letters of the names of program units: "ft", "die_oil_" under a prefix, or the stem of one
// of several laws.
std::string stem(const ExportRequest& request);
// First letters for the units that the entry itself calls: "ft", or "f0" if there are several laws.
std::string entry_stem(const ExportRequest& request);

// Parts of the combined file that depend on the target.
struct Combination {
  const Exporter& exporter;
  std::string entry;     // "vfric"
  std::string arguments; // head of the entry: argument list and declarations
  std::string quit;      // ftquit of fortran::Core
  const LawSelector& by;
};

// Combines the bundles of several laws. `laws` are from named_laws(), `bundles` have the files of
// each alone. Files without the entry, whose units the solver's own code calls by name ("ftupd"),
// are kept once for all laws; throws InputError if such a file depends on one of the laws.
SourceBundle combine(const Combination& combination, const std::vector<ExportRequest>& laws,
                     const std::vector<SourceBundle>& bundles);

// Returns the bundle of one law with its linked names, those of program units and COMMON blocks,
// under the request's prefix; unchanged if it has none. The entry, and what the solver's code calls
// by name ("ftupd"), keep their names. Throws InputError if a name has another meaning in the
// source.
SourceBundle under_prefix(const SourceBundle& bundle, const ExportRequest& request);

inline constexpr const char* combined_schema = "frictab/combined-recipe/1";

} // namespace frictab::codegen
