// Calls a Fortran routine as its solver would. The call itself is a file in the language of the
// solver's manual: templates/<vendor>/<target>/driver.f, a subroutine
//
//   ftdriv(n, ns, v, np, prop, nf, field, nh, hist, tau)
//     integer*4 n, ns, np, nf, nh
//     real*8 v(ns,n), prop(np), field(nf,n), hist(nh,n), tau(n)
//
// that is compiled with the routine and shares nothing with it. It puts n contact points where the
// solver has them and gives back what the routine says of each. v(i,k): the state of row i of the
// solver's table (SolverGives::states) at point k; prop: the deck's properties; field: field
// variables; hist: state variables of further histories (codegen/histories.h). All in the solver's
// units. @{contact} is what tells the contact apart where the routine has several laws: the name or
// number of the law that is asked for.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "codegen/coefficient.h"
#include "codegen/solver_inputs.h"

namespace frictab::codegen {

struct Driver {
  const SolverGives& gives;
  fortran::Coefficient result = fortran::Coefficient::stress; // what the routine says
  std::size_t most_points = 1;                                // in a call of ftdriv
  // Where a law asks for the peak pressure and not for the pressure, the one stands for both.
  bool peak_presses = false;
  // A temperature of exactly 0 says that there is none: such a row cannot be represented.
  bool zero_is_no_temperature = false;
};

// As Exporter::drive; `inputs` are those of the driver's table for this request. Rows that
// contradict themselves as the state of a contact point (two sliding distances, a peak below the
// present pressure) are left unchanged. Constants of the source are set where it has them in
// COMMON /FTCONS/ (of one of several laws, /F1CONS/ and so on).
void drive_routine(const Driver& driver, const std::vector<SolverInput>& inputs, const Built& built,
                   const ExportRequest& request, std::size_t rows,
                   std::span<const double* const> columns, std::span<double> tau);

// Adds the driver's file to what the variant compiles.
void add_driver(BuildVariant& variant, const std::string& text);

} // namespace frictab::codegen
