// Parts of a routine for Abaqus that end the analysis, find the job's directory, and distinguish
// contacts.
#pragma once

#include <string>

#include "codegen/combine.h"
#include "codegen/exporter.h"

namespace frictab::abaqus {

enum class Solver { explicit_, standard };

// Returns ftquit(text) of fortran::Core, which calls XPLB_ABQERR or STDB_ABQERR.
std::string quit(Solver solver);

// Returns VGETOUTDIR (seen in public routines) or GETOUTDIR (recalled).
std::string directory_routine(Solver solver);

// Distinguishes contacts by the argument with the name of the *SURFACE INTERACTION. `letters` are
// reserved for the routine among all of its solver (LawSelector).
codegen::LawSelector interaction(Solver solver, const std::string& argument,
                                 const std::string& letters);
// Adapts a selector to general contact, where the lines for the deck name surfaces.
codegen::LawSelector of_general_contact(codegen::LawSelector by);

// Adds stand-ins for these routines of the solver to a source's compilation here.
void add_stand_ins(codegen::BuildVariant& variant, Solver solver);

} // namespace frictab::abaqus
