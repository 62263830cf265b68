// Columns that are computed from others, after mapping: slopes of paths, formulas of the job,
// coefficients, eq. 1 of the paper, the sliding distance.
#pragma once

#include <string>
#include <vector>

#include "data/options.h"
#include "data/part.h"

namespace frictab::data {

// |d column/d time_s| of columns that are paths; that of the speed also with its sign (signs.h).
void take_slopes(Part& part, const DataOptions& options);

// [data.columns] NAME = { formula = "rpm*radius_mm*2*pi/60" }. Names in a formula are quantities,
// in their canonical units, or other columns of the data, as the file gives them: by their names,
// or by these with _ for every sign that is no letter or digit, without a unit behind them; pi is
// known. A formula may use the columns of other formulas. Faults are told at the formula. Where a
// formula of the speed, the friction or the stress makes a magnitude of a column with a sign
// (abs(x), sqrt(x^2)), its values with that sign are kept as well (signs.h).
void compute_formulas(Part& part, const DataOptions& options);

// The quantities whose formulas in the job, of all or of some files, use a column of this name.
std::vector<std::string> computed_from(const DataOptions& options, const std::string& column);

// Measured coefficients times the column that the job names.
void multiply_coefficients(Part& part, const DataOptions& options);

// Eq. 1 of the paper: mu_meas = F_R/F_N, tau_R = mu_meas sigma_N. A fault where the data have
// neither a stress nor the forces and need them (options.measured).
void derive_shear_stress(Part& part, const DataOptions& options);
// That tau_R once more, from forces that have changed.
void fill_shear_stress(Part& part);

// s_mm from v_rel_mm_s and time_s, by the trapezoidal rule.
void integrate_distance(Part& part);

} // namespace frictab::data
