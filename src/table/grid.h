// Nodes of one axis, and the error that interpolation along it leaves.
#pragma once

#include <map>
#include <vector>

#include "expr/program.h"
#include "table/build.h"
#include "table/table.h"

namespace frictab::table {

// Names of the ranges, and the same behind "value": the columns of the two programs below.
std::vector<std::string> names_of(const std::vector<StateRange>& ranges);
std::vector<std::string> with_value(const std::vector<StateRange>& ranges);

// The tabulated piece of a law, and tau_R from it, as functions of all states of its ranges.
struct Pieces {
  Pieces(const models::AssembledLaw& law, const std::vector<StateRange>& ranges);
  std::vector<std::string> names;
  expr::Program value;
  expr::Program combine; // row: value, then names
  std::vector<double> parameters;
};

// An axis whose number of nodes is still open.
struct AxisPlan {
  TableAxis axis;
  std::size_t input = 0;     // of the ranges
  std::vector<double> fixed; // nodes there must be: ends and kinks, canonical, ascending
  std::size_t cells = 1;     // between the ends, at least
  bool by_user = false;      // the job says how many
  bool even = false;         // the job asks for even spacing
  // Where the nodes are dense: cells share out the measure, which ascends from 0 to 1 over the
  // positions (coordinates of the axis). Empty: evenly spaced in the coordinate.
  std::vector<double> position, measure;
};

// The axis with `cells` cells (or some more: every fixed node stays one).
TableAxis axis_with(const AxisPlan& plan, std::size_t cells);

// Measures interpolation along one axis at a time, on lines through the box of states.
class AxisErrors {
public:
  // Lines fill the box; those through ends and through the inside alternate, since errors of
  // monotone laws are largest at the ends.
  AxisErrors(const Pieces& pieces, const std::vector<StateRange>& ranges, bool log_value,
             bool cubic);

  // One more line per axis, through this state.
  void add(const std::vector<double>& state);

  // Largest error of tau_R in MPa in the middle of each cell.
  std::vector<double> by_cell(const AxisPlan& plan, const TableAxis& axis) const;
  double largest(const AxisPlan& plan, std::size_t cells) const;

  // Fewest cells with which the error along the axis stays below `target`, taking it that more
  // cells err less.
  std::size_t cells_for(const AxisPlan& plan, double target) const;

  // Dense where the error of even spacing is large, so that all cells err alike (de Boor's
  // equidistribution, with measured errors); empty where that saves less than a fifth of the nodes:
  // even nodes are found without search.
  void distribute_nodes(AxisPlan& plan, double target) const;

private:
  std::vector<double> between(const TableAxis& axis, std::vector<double> nodes) const;

  const Pieces& pieces_;
  std::vector<std::vector<double>> lines_; // per state: one value per line
  bool log_value_;
  bool cubic_;
};

} // namespace frictab::table
