// What every target needs to fill its templates: inputs with their units in the solver's system,
// numbers that round-trip, lists broken into lines.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "expr/expr.h"
#include "table/table.h"

namespace frictab {

// A unit of the solver: canonical = value * times / over (one of the two is 1, so that every
// conversion is one correctly rounded operation).
struct SolverUnit {
  std::string name;
  double times = 1;
  double over = 1;
  double to_canonical(double value) const { return value * times / over; }
  double from_canonical(double value) const { return value / times * over; }
  bool same() const { return times == 1 && over == 1; }
};

// `units` is mm-t-s or m-kg-s; throws InputError for another one. Units without a counterpart
// (degC, 1, a traced column's) stay as they are.
SolverUnit solver_unit(std::string_view canonical_unit, std::string_view units);

// One state of the law as an argument of generated code.
struct InputArgument {
  std::string name;     // canonical
  std::string argument; // with the solver's unit: sigma_n_Pa; an identifier in C and Fortran
  std::string meaning;
  std::string unit; // canonical
  SolverUnit solver;
  bool used = false;               // the table needs it
  std::optional<std::size_t> axis; // where it is an axis
};

// sigma_n_MPa, psi, v_rel_mm_s, T_contact_C, s_mm, sigma_f_MPa as the contract lists them, then the
// table's further inputs.
std::vector<InputArgument> entry_arguments(const Table& table, std::string_view units);

// The states a table was made and verified for: its axis, or the attributes range_low_<name> and
// range_high_<name> of a state that only the formula uses; nullopt where neither is there.
std::optional<std::pair<double, double>> known_range(const Table& table, const std::string& name);

// The value an input has where the solver gives none: the middle of its range (of its logarithms
// where that is the quantity's coordinate); nullopt where no range is known.
std::optional<double> typical_value(const Table& table, const std::string& name);

// "keeps 57.1 MPa below 500 MPa of contact normal stress ...": where tau_R does not fall with a
// pressure below the table's range, as at the edge of a contact, and its other states are typical;
// else empty.
std::string edge_text(const Table& table);

// Most numbers (nodes, values, cell polynomials) that a source may hold: gfortran takes 281 MB and
// 4 to 7 s for 210,000 in DATA statements.
inline constexpr std::size_t most_baked_numbers = 300000;

// Numbers that the source of a table, or of its direct form, holds.
std::size_t baked_numbers(const Table& table);

// Throws InputError where a table cannot be made into code: values that are not finite, sizes that
// do not fit, more axes than the kernel holds, no law's formula where the table goes on by it.
void check_table(const Table& table);

// How a table gets smaller: the hint of what refuses one.
inline constexpr const char* smaller_table =
    "a larger table.tolerance_MPa, narrower ranges, or a law of fewer states; export.targets = [] "
    "makes the table alone";

// Throws InputError where the source would hold more numbers than a compiler takes; `elsewhere` of
// them are not in it. Needs no values: `table` may be a description. `remedy`: a further one.
void check_table_size(const Table& table, std::size_t elsewhere = 0,
                      const std::string& remedy = {});

// Whether the code needs the spline kernel: a cubic table with axes.
bool is_cubic(const Table& table);

// What the routine looks up, per node: values, or coefficients of the spline with the 2 zeros that
// its kernel reads behind them.
std::vector<double> baked_values(const Table& table);

// Text from outside (names, attributes) that stays inside a comment of C or Fortran.
std::string comment_text(std::string_view text);

// 17 significant digits at most, reads back to the same bits. C: 1.0, 1e-20. Fortran: 1.0D0.
std::string c_number(double value);
std::string fortran_number(double value);

// "500 .. 2750 MPa" in the solver's unit, with a remark where the state is no axis.
std::string range_text(const InputArgument& input, const Table& table);

// What the sides of the axes do where one does not clamp: "psi below 1: clamp, above 20: law".
// Empty where all clamp.
std::vector<std::string> outside_lines(const Table& table);

// "worst drift ..., measured in verification" or "not known"; from the table's attributes.
std::string drift_text(const Table& table);
std::string origin_text(const Table& table);

// Items with commas between them, broken into lines of at most `width` columns behind `indent`.
std::string number_lines(const std::vector<std::string>& items, std::size_t width,
                         const std::string& indent);

// Text broken at blanks into lines of at most `width` columns.
std::vector<std::string> wrap_text(std::string_view text, std::size_t width);

// A Fortran statement in fixed form: columns 7..72, continuation lines marked in column 6. Throws
// std::logic_error where it would need more than 19 of them.
std::string fixed_form(const std::string& statement);

// DATA statements for name(1..n), each within 72 columns and 19 continuation lines.
std::string fixed_form_data(const std::string& name, std::span<const double> values);
std::string fixed_form_data(const std::string& name, const std::vector<int>& values);

} // namespace frictab
