// How a routine for Abaqus ends the analysis, asks where the job lies, and knows one contact from
// another.
#pragma once

#include <string>

#include "codegen/combine.h"
#include "codegen/exporter.h"

namespace frictab::abaqus {

enum class Solver { explicit_, standard };

// ftquit(text) of fortran::Core, by XPLB_ABQERR or STDB_ABQERR.
std::string quit(Solver solver);

// VGETOUTDIR (seen in public routines) or GETOUTDIR (recalled).
std::string directory_routine(Solver solver);

// *SURFACE INTERACTION by the argument that has its name. `letters` are the routine's own among
// those of its solver (LawSelector).
codegen::LawSelector interaction(Solver solver, const std::string& argument,
                                 const std::string& letters);
// Where the contact is general: the lines for the deck name surfaces.
codegen::LawSelector of_general_contact(codegen::LawSelector by);

// Adds stand-ins for these routines of the solver to how a source is compiled here.
void add_stand_ins(codegen::BuildVariant& variant, Solver solver);

} // namespace frictab::abaqus
