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

// *SURFACE INTERACTION by the argument that has its name, for contact pairs or where the contact is
// general.
codegen::LawSelector interaction(const std::string& argument, bool general = false);

// Adds stand-ins for these routines of the solver to how a source is compiled here.
void add_stand_ins(codegen::BuildVariant& variant, Solver solver);

} // namespace frictab::abaqus
