// Contour plots of friction in Abaqus/Explicit. Its friction routines have no output of their own;
// with the option `contact_fields = "vufield"` VFRIC and VFRICTION hand the coefficient, the stress
// and the count of increments outside the range to a VUFIELD beside them, by the number of the
// node, which gives them back as field variables 1 to 3 (output FV). The same way as public
// routines that ran in production (RWTH WZL), whose arrays have a fixed size and no locks.
#pragma once

#include <string>
#include <vector>

#include "codegen/solver_inputs.h"
#include "core/template.h"

namespace frictab::abaqus {

// "none", "vufield", "vufield_windows" (which has other locks).
codegen::ExportOption contact_fields_option();

bool has_contact_fields(const codegen::ExportRequest& request);

// The file of VUFIELD, and its name in the bundle. It knows no law: with several laws it stands
// once.
inline constexpr const char* contact_fields_file = "frictab_vufield.f";
std::string contact_fields_source(const codegen::ExportRequest& request);

// Throws InputError where the law takes one of the field variables itself.
void check_contact_fields(const codegen::ExportRequest& request,
                          const std::vector<codegen::SolverInput>& inputs);

// For the input deck, in the step; empty without the option.
std::string contact_fields_lines(const codegen::ExportRequest& request);

} // namespace frictab::abaqus
