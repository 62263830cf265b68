// The part of a Fortran source that is the same for every solver: tau_R of a state, in fixed form.
//
//   tau_R = combine(value, x)
//
// x are the law's inputs, `combine` is the law's formula around what is tabulated (table/table.h).
// The value is looked up: every axis has a coordinate u = x or ln x, and between nodes the value is
// interpolated in u, linearly over the 2^n corners of a cell, or by a tensor product of cubic
// B-splines (table/spline.h). Where a table holds the logarithm, the value is exp of that. Beyond
// an end of an axis it is the value at the end, the law's own formula, or NaN, as the axis says. In
// the direct form the value is the law's formula everywhere.
//
// The derivatives are those of the very interpolation, not of the law behind it, so that a solver's
// tangent fits its residual:
//
//   dtau_R/dx_i = dcombine/dx_i + dcombine/dvalue * dvalue/du_i * du_i/dx_i
//
// Statements stand in the order of the C kernels (table/frictab_kernel.h, frictab_cubic.h), and
// nothing contracts them, so that Fortran, C and frictab itself agree to the last bits. They are
// written out for one table, with its sizes and strides as numbers: a Fortran compiler does not
// find these by itself. All names start with ft, because a program has one space of names for
// subroutines, which the solver's own are in.
#pragma once

#include "codegen/exporter.h"
#include "codegen/fortran_parts.h"
#include "codegen/solver_inputs.h"

namespace frictab::codegen::fortran {

// fttau(x): tau_R in MPa of x(1..n), the table's inputs in canonical units, NaN where one of them
// is; ftnan(x); where the table has axes, ftout(x), true beyond one of their ends; where asked for,
// ftqnan(), a quiet NaN, and the subroutine ftgrad(x, tau, dtau): fttau's value, bit for bit, and
// its derivatives by x(1..n) in MPa per canonical unit, those of TableFunction::gradient; all NaN
// where an input is NaN and where a side refuses (tau is then what fttau says). With everything
// they call, as program units whose only state is the values of a large table (values_file.h).
// Where a side refuses, also ftstop(x): true where x lies beyond such a side by more than single
// precision misses it, after ftquit(text) with state and value; false where one of x is NaN. And
// ftquit, where anything calls it. Neither where no `quit` is given, no ftstop in a module.
struct Core {
  std::string text; // without the line break at its end
  std::string data; // of a module: the numbers of these units, with their declarations
  std::size_t n_x;  // at least 1
};
struct CoreOptions {
  bool unknown = false;  // ftqnan
  bool gradient = false; // ftgrad
  Units units = Units::external;
  std::string quit = {};    // ftquit(text), which says the text and ends the analysis
  bool quits = false;       // others than this core call it
  std::string summary = {}; // ftseen(x), which ftout calls (codegen/outside_summary.h)
  // The solver's routine that gives the directory of the job and its length; none: empty.
  std::string directory_routine = {};
};
Core core(const ExportRequest& request, const CoreOptions& options);

// The units of a module, or its data, in free form: comments, continuation, named ends, kinds
// instead of lengths in bytes.
std::string free_form(const std::string& fixed);

// What the comments at the head of a source say beyond the request.
struct Head {
  std::string error_action = {}; // beyond a side with outside = error: "CSTOP ends the analysis"
  std::string directory_routine = {};    // as in CoreOptions
  std::vector<std::string> release = {}; // which release's argument list it is; empty: no word
  FurtherProperties further_properties = {};
};

// Adds what every source is filled with: text head (templates/fortran/frictab_head.f: law, data,
// units, drift, states, what holds outside, where a file of values lies), from ("from a table"),
// n_x, stress and length (unit names), to_solver ("*1.0D6", from MPa to the solver's unit); lists
// properties (n_props of them) and source (where the argument list comes from); flag refuses, where
// a side has outside = error. Units and properties are offered.
void add_head(TemplateValues& values, const Exporter& exporter, const ExportRequest& request,
              const std::vector<SolverInput>& inputs, const Head& head);

} // namespace frictab::codegen::fortran
