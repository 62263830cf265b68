// Answers beyond the ends of a table's axes, and the counting of such states.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "expr/program.h"
#include "table/table.h"

namespace frictab::table {

// Default answer beyond the low end of an axis. Below all tested contact normal stresses it is the
// law: a clamped tau_R would stay constant where the contact pressure vanishes, and most contact
// points of a forming process begin there. For other axes, and beyond the high end of every axis:
// clamp.
Outside usual_below(std::string_view axis);

// Answer below the tested contact normal stresses; the law if they are not an axis.
Outside below_pressures(const Table& table);

// Tolerance of an end, as a part of its own value. A solver in single precision misses an end by
// rounding; a state beyond it by no more than this is not refused.
inline constexpr double end_rounding = 1e-6;

// The range of one axis, or of an input that the law itself clamps, with the answers on either
// side.
struct AxisEnds {
  explicit AxisEnds(const TableAxis& axis, std::size_t number_of_input = 0);
  AxisEnds(const std::string& held_input, std::size_t number_of_input,
           std::pair<double, double> range);

  std::string name;
  std::size_t input; // index in Table::inputs()
  double low, high;
  Outside below, above;
  bool clamped_by_law = false; // not an axis: the law clamps this input to the same ends
  // Queries are refused beyond these, further out than end_rounding; infinite for a side that does
  // not refuse.
  double refused_below, refused_above;

  bool leaves(double x) const { return x < low || x > high; }
  bool refuses(double x) const { return x < refused_below || x > refused_above; }
  // Whether x is beyond a side on which the law's own formula answers.
  bool extends(double x) const {
    return (x < low && below == Outside::law) || (x > high && above == Outside::law);
  }
  // The value at which the formula is evaluated: x itself beyond such a side, clamped to the end on
  // every other.
  double asked_at(double x) const {
    if (x < low && below != Outside::law) return low;
    return x > high && above != Outside::law ? high : x;
  }
};

std::vector<AxisEnds> axis_ends(const Table& table);

// Inputs that are not axes and were tested over a limited range: those that `combine` clamps to its
// ends (traced effects), and numbers of levels. Beyond the range the formula answers as the law
// does.
std::vector<AxisEnds> clamped_input_ends(const Table& table);

// Both axis_ends and clamped_input_ends, in this order: bit i of `outside` is the i-th of them.
std::vector<AxisEnds> all_ends(const Table& table);

// Answers where interpolation does not: beyond a side with `error` (NaN) or `law`, and everywhere
// for the direct form. All other axes are clamped to their ends, so that all forms of a table
// agree.
class OutsideRule {
public:
  static bool needed(const Table& table); // some side does not clamp, or the table has no values
  explicit OutsideRule(const Table& table);

  // Same contract as TableFunction; nullopt where the table itself answers.
  std::optional<double> tau(std::span<const double> state, unsigned* outside) const;
  std::optional<double> gradient(std::span<const double> state, std::span<double> derivative,
                                 unsigned* outside) const;

private:
  enum class Answer { table, law, none };
  Answer prepare(std::span<const double> state, double* row, unsigned* outside) const;

  bool direct_;
  std::vector<AxisEnds> ends_;
  std::unique_ptr<expr::Program> law_; // row: inputs, then the clamped axes
  std::vector<double> constants_;
};

} // namespace frictab::table
