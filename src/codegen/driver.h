// Calls a Fortran routine as its solver would. The call itself is a file in the language of the
// solver's manual: templates/<vendor>/<target>/driver.f, a subroutine
//
//   ftdriv(n, ns, v, np, prop, nf, field, nh, hist, tau)
//     integer*4 n, ns, np, nf, nh
//     real*8 v(ns,n), prop(np), field(nf,n), hist(nh,n), tau(n)
//
// that is compiled with the routine and shares nothing with it. It puts n contact points where the
// solver has them and returns the routine's result for each. v(i,k): the state of row i of the
// solver's table (SolverGives::states) at point k; prop: the deck's properties; field: field
// variables; hist: state variables of further histories (codegen/histories.h). All are in the
// solver's units. @{contact} is the name or number of the law to call, if the routine has several.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "codegen/coefficient.h"
#include "codegen/solver_inputs.h"

namespace frictab::codegen {

struct Driver {
  const SolverGives& gives;
  // Result of the routine.
  fortran::Coefficient result = fortran::Coefficient::stress;
  std::size_t most_points = 1; // largest number of points per call of ftdriv
  // If the law takes the peak pressure and not the pressure, the peak is used for both.
  bool peak_presses = false;
  // The routine takes a temperature of exactly 0 (in the solver's unit) as missing: such a row
  // cannot be represented.
  bool zero_is_no_temperature = false;
};

// Implements Exporter::drive; `inputs` are those of the driver's table for this request. Leaves
// rows unchanged that contradict themselves as the state of a contact point (two sliding distances,
// a peak below the present pressure). Sets constants of the source if it has them in COMMON
// /FTCONS/ (/F1CONS/ and so on for one of several laws).
void drive_routine(const Driver& driver, const std::vector<SolverInput>& inputs, const Built& built,
                   const ExportRequest& request, std::size_t rows,
                   std::span<const double* const> columns, std::span<double> tau);

} // namespace frictab::codegen
