// The part of a Fortran source that is the same for every solver: tau_R of a state, in fixed form.
//
//   tau_R = combine(value, x)
//
// x are the law's inputs, `combine` is the law's formula around the tabulated value
// (table/table.h). The value is looked up: every axis has a coordinate u = x or ln x, and between
// nodes the value is interpolated in u, linearly over the 2^n corners of a cell, or by a tensor
// product of cubic B-splines (table/spline.h). If a table has the logarithm of the value, the
// result is exp of it. Beyond an end of an axis it is the value at the end, the law's own formula,
// or NaN, as the axis specifies. In the direct form the value is the law's formula everywhere.
//
// The derivatives are those of the interpolation itself, not of the law, so that a solver's tangent
// fits its residual:
//
//   dtau_R/dx_i = dcombine/dx_i + dcombine/dvalue * dvalue/du_i * du_i/dx_i
//
// Statements are in the order of the C kernels (table/frictab_kernel.h, frictab_cubic.h), and no
// operations are contracted, so that Fortran, C and frictab itself agree to the last bits. They are
// written out for one table, with its sizes and strides as numbers, because a Fortran compiler does
// not find these by itself. All names start with ft, because a program has one name space for all
// subroutines, including the solver's own.
#pragma once

#include "codegen/exporter.h"
#include "codegen/fortran_parts.h"
#include "codegen/solver_inputs.h"

namespace frictab::codegen::fortran {

// Program units, with everything they call. Their only state is the values of a large table
// (values_file.h).
//   fttau(x): tau_R in MPa of x(1..n), the table's inputs in canonical units; NaN if one of them
//   is.
//   ftnan(x): true if one of them is NaN.
//   ftout(x), if the table has axes: true beyond one of their ends.
//   ftqnan(), if requested: a quiet NaN.
//   ftgrad(x, tau, dtau), if requested: fttau's value, bit for bit, and its derivatives by x(1..n)
//   in MPa per canonical unit, equal to TableFunction::gradient. All derivatives are NaN if an
//   input is NaN or a side refuses; tau is then as in fttau.
//   ftstop(x), if a side refuses (not in a module): true if x lies beyond such a side by more than
//   the rounding of single precision, after a call of ftquit(text) with state and value; false if
//   one of x is NaN.
//   ftquit(text), if anything calls it.
// Without `quit` there is neither ftstop nor ftquit.
struct Core {
  std::string text; // without the line break at the end
  std::string data; // for a module: the numbers of these units, with declarations
  std::size_t n_x;  // at least 1
};
struct CoreOptions {
  bool unknown = false;  // add ftqnan
  bool gradient = false; // add ftgrad
  Units units = Units::external;
  std::string quit = {}; // ftquit(text), which prints the text and ends the analysis
  bool quits = false;    // units outside this core call it
  // ftseen(x), which ftout calls (codegen/outside_summary.h).
  std::string summary = {};
  // The solver's routine that returns the directory of the job and its length; empty: none.
  std::string directory_routine = {};
};
Core core(const ExportRequest& request, const CoreOptions& options);

// Converts the units of a module, or its data, to free form: comments, continuation, named ends,
// kinds instead of lengths in bytes.
std::string free_form(const std::string& fixed);

// Facts for the comments at the head of a source that the request does not have.
struct Head {
  // Effect beyond a side with outside = error: "CSTOP ends the analysis".
  std::string error_action = {};
  std::string directory_routine = {}; // as in CoreOptions
  // Release whose argument list it is; empty: not stated.
  std::vector<std::string> release = {};
  FurtherProperties further_properties = {};
};

// Adds the values that every source needs: text head (templates/fortran/frictab_head.f: law, data,
// units, drift, states, behaviour outside the range, place of the values file), from ("from a
// table"), n_x, stress and length (unit names), to_solver ("*1.0D6", from MPa to the solver's
// unit); lists properties (n_props of them) and source (origin of the argument list); flag refuses,
// if a side has outside = error. Units and properties are optional for templates.
void add_head(TemplateValues& values, const Exporter& exporter, const ExportRequest& request,
              const std::vector<SolverInput>& inputs, const Head& head);

} // namespace frictab::codegen::fortran
