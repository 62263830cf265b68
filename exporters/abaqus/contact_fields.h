// Contour plots of friction in Abaqus/Explicit, whose friction routines have no output of their
// own. With the option `contact_fields = "vufield"` VFRIC and VFRICTION pass the coefficient, the
// stress and the count of increments outside the range, by node number, to a VUFIELD in the same
// user file, which returns them as field variables 1 to 3 (output FV). Public routines that ran in
// production (RWTH WZL) work in the same way, but their arrays have a fixed size and no locks.
#pragma once

#include <string>
#include <vector>

#include "codegen/solver_inputs.h"
#include "core/template.h"

namespace frictab::abaqus {

// Option with values "none", "vufield", "vufield_windows" (which uses Windows locks).
codegen::ExportOption contact_fields_option();

bool has_contact_fields(const codegen::ExportRequest& request);

// Source of VUFIELD, and its name in the bundle. It does not depend on a law, so it is kept once
// for several laws.
inline constexpr const char* contact_fields_file = "frictab_vufield.f";
std::string contact_fields_source(const codegen::ExportRequest& request);

// Throws InputError if the law itself takes one of the field variables.
void check_contact_fields(const codegen::ExportRequest& request,
                          const std::vector<codegen::SolverInput>& inputs);

// Returns lines for the step of the input deck; empty without the option.
std::string contact_fields_lines(const codegen::ExportRequest& request);

} // namespace frictab::abaqus
