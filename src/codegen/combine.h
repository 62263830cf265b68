// Several laws in one user file: different lubricants on punch and die. The file has one entry with
// the solver's own argument list, which calls the law that belongs to the contact it is asked for.
// Each law's source is what it is alone, but for the names of its program units: "ft" gives way to
// a stem of the law's own (fttau -> f1tau, f2tau), which stands in front of its entry as well
// (vfric -> f1vfric). A contact that none of the laws is for ends the analysis.
//
// A solver may want several entries in its one user file (VFRIC for contact pairs, VFRICTION for
// general contact): their stems differ, so that their sources can stand behind each other.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/exporter.h"
#include "core/error.h"

namespace frictab::codegen {

// How the arguments of an entry tell contacts apart.
struct LawSelector {
  std::string argument = {}; // "surfInt"; empty: they do not, and no laws are combined
  std::string meaning = {};  // "name of the *SURFACE INTERACTION"; where there is no argument: why
  bool number = false;       // else the deck's text, padded with blanks
  std::string alone = {};    // what drivers say where there is one law: "FRICTAB"
  std::string guard = {};    // statements in front: calls that ask for no friction
  std::string letters = "fgh"; // stems: f1 to f9, g1 ...; f0 of the entry's own units
  std::string user_file = {};  // what may stand in one user file with it
  // In the lines for the input deck: what stands for the name ("FRICTAB"), and what takes its place
  // where there are several laws, with the name as @.
  std::vector<std::pair<std::string, std::string>> deck = {};
};

// Requests of one target, its options and units the same in all, as the parts of one file: each
// with its name and stem. Throws InputError where there are no or too many of them, where a name
// is no name by which this solver could call, or where two are the same (case does not count).
std::vector<ExportRequest> named_laws(std::vector<ExportRequest> laws,
                                      const std::vector<std::string>& names, const LawSelector& by);

// What `make` gives; faults that it throws say whose they are: "PUNCH: ...".
template <class Make> auto said_of(const std::string& whose, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    std::vector<Fault> faults = error.faults();
    for (Fault& fault : faults)
      fault.what = whose + ": " + fault.what;
    throw InputError(std::move(faults));
  }
}

// What names of program units start with: "ft", or the stem of one of several laws.
std::string stem(const ExportRequest& request);
// Those that the entry calls itself: "ft", or "f0" where there are several laws.
std::string entry_stem(const ExportRequest& request);

// What the combined file is made of.
struct Combination {
  const Exporter& exporter;
  std::string entry;     // "vfric"
  std::string arguments; // its head: argument list and declarations
  std::string quit;      // ftquit of fortran::Core
  const LawSelector& by;
};

// `laws` are named_laws(), `bundles` what each gives alone. A source without the entry, which the
// solver's own code calls by its name ("ftupd"), stands once: throws InputError where it would have
// to know one of the laws.
SourceBundle combine(const Combination& combination, const std::vector<ExportRequest>& laws,
                     const std::vector<SourceBundle>& bundles);

inline constexpr const char* combined_schema = "frictab/combined-recipe/1";

} // namespace frictab::codegen
