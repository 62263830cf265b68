// What lies beyond the ends of a table's axes: who is asked there, and what a run counts.
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

// What holds beyond the low end of an axis where the job says nothing: the law below every
// contact normal stress that was tested, because a clamped tau_R stays where the contact has no
// pressure left, and most contact points of a forming process begin there. Elsewhere, and beyond
// the high end of every axis: clamp.
Outside usual_below(std::string_view axis);

// What holds below the contact normal stresses that were tested; the law where they are no axis.
Outside below_pressures(const Table& table);

// A solver in single precision misses an end by rounding: what lies beyond it by no more than this
// part of the end's own value is not refused.
inline constexpr double end_rounding = 1e-6;

// The range of one axis, or of an input that is held, with what holds on either side of it.
struct AxisEnds {
  explicit AxisEnds(const TableAxis& axis, std::size_t number_of_input = 0);
  AxisEnds(const std::string& held_input, std::size_t number_of_input,
           std::pair<double, double> range);

  std::string name;
  std::size_t input; // of Table::inputs()
  double low, high;
  Outside below, above;
  bool held = false; // no axis: the law holds this input at the same ends
  // Beyond these a query is refused: by more than end_rounding. Infinite where the side does not.
  double refused_below, refused_above;

  bool leaves(double x) const { return x < low || x > high; }
  bool refuses(double x) const { return x < refused_below || x > refused_above; }
  // Beyond a side on which the law's own formula is asked.
  bool extends(double x) const {
    return (x < low && below == Outside::law) || (x > high && above == Outside::law);
  }
  // Where the formula is asked: at the end instead of beyond it on every other side.
  double asked_at(double x) const {
    if (x < low && below != Outside::law) return low;
    return x > high && above != Outside::law ? high : x;
  }
};

std::vector<AxisEnds> axis_ends(const Table& table);

// Inputs that are no axis and were tested over a range only: those that `combine` holds at its ends
// (traced effects), and numbers of levels. Beyond it the formula answers as the law does.
std::vector<AxisEnds> held_input_ends(const Table& table);

// Both, in this order: bit i of `outside` is the i-th of them.
std::vector<AxisEnds> all_ends(const Table& table);

// Answers where interpolation does not: beyond a side with `error` (NaN) or `law`, and everywhere
// for the direct form. Axes that are not beyond a side with `law` are held at their ends, so that
// all forms of a table agree.
class OutsideRule {
public:
  static bool needed(const Table& table); // a side that does not clamp, or no values at all
  explicit OutsideRule(const Table& table);

  // As TableFunction's; nothing where the table itself is to be asked.
  std::optional<double> tau(std::span<const double> state, unsigned* outside) const;
  std::optional<double> gradient(std::span<const double> state, std::span<double> derivative,
                                 unsigned* outside) const;

private:
  enum class Answer { table, law, none };
  Answer prepare(std::span<const double> state, double* row, unsigned* outside) const;

  bool direct_;
  std::vector<AxisEnds> ends_;
  std::unique_ptr<expr::Program> law_; // row: inputs, then the axes as held
  std::vector<double> constants_;
};

} // namespace frictab::table
