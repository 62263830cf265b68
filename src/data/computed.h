// Columns computed from others, after mapping: slopes of paths, formulas of the job, coefficients,
// eq. 1 of the paper, the sliding distance.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "data/options.h"
#include "data/part.h"

namespace frictab::data {

// |d column/d time_s| of path columns; for the speed, the signed slope is kept as well (signs.h).
void take_slopes(Part& part, const DataOptions& options);

// Evaluates [data.columns] NAME = { formula = "rpm*radius_mm*2*pi/60" }. Names in a formula are
// quantities in their canonical units, or other columns as the file gives them: by their names
// without a trailing unit, with _ for every character other than letters and digits; _ may stand
// for a letter beyond ASCII as well. pi is known. A formula may use the columns of other formulas.
// Faults are reported at the formula. If a formula of the speed, the friction or the stress takes
// the magnitude of a signed column (abs(x), sqrt(x^2)), its signed values are kept as well
// (signs.h).
void compute_formulas(Part& part, const ReadRequest& options);

// A column's name as formulas write it: "Drehzahl innen [1/min]" is Drehzahl_innen.
std::string name_in_formulas(const std::string& column);

// The names that formulas of the job, for all or some files, use.
std::set<std::string> names_in_formulas(const DataOptions& options);
// Whether one of these names is the column's.
bool is_named_by(const std::set<std::string>& names, const std::string& column);

// The quantities whose formulas in the job, for all or some files, use a column of this name.
std::vector<std::string> computed_from(const DataOptions& options, const std::string& column);

// Multiplies measured coefficients by the column that the job names.
void multiply_coefficients(Part& part, const DataOptions& options);

// Eq. 1 of the paper: mu_meas = F_R/F_N, tau_R = mu_meas sigma_N. Adds a fault if the data need
// tau_R (options.measured) and have neither a stress nor the forces.
void derive_shear_stress(Part& part, const ReadRequest& options);
// Recomputes tau_R of derive_shear_stress() after the forces have changed.
void fill_shear_stress(Part& part);

// s_mm from v_rel_mm_s and time_s, by the trapezoidal rule.
void integrate_distance(Part& part);

} // namespace frictab::data
