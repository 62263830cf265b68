// Nodes of one axis, and the error of interpolation along it.
#pragma once

#include <map>
#include <vector>

#include "expr/program.h"
#include "table/build.h"
#include "table/table.h"

namespace frictab::table {

// Names of the ranges, preceded by "value": the columns of Pieces::combine.
std::vector<std::string> with_value(const std::vector<StateRange>& ranges);

// The tabulated piece of a law, and tau_R from it, as functions of all states of its ranges.
struct Pieces {
  Pieces(const models::AssembledLaw& law, const std::vector<StateRange>& ranges);
  std::vector<std::string> names;
  expr::Program value;
  expr::Program combine; // row: value, then names
  std::vector<double> parameters;
};

// An axis whose number of nodes is not yet fixed.
struct AxisPlan {
  TableAxis axis;
  std::size_t input = 0;     // index among the ranges
  std::vector<double> fixed; // required nodes: ends and kinks, canonical unit, ascending
  std::size_t cells = 1;     // least number of cells between the ends
  bool by_user = false;      // the job gives the number of nodes
  bool even = false;         // the job requires even spacing
  // Node density: each cell gets the same share of `measure`, which ascends from 0 to 1 over
  // `position` (coordinates of the axis). Empty: evenly spaced in the coordinate.
  std::vector<double> position, measure;
};

// Returns the axis with `cells` cells, or some more: every fixed node is kept.
TableAxis axis_with(const AxisPlan& plan, std::size_t cells);

// Measures interpolation along one axis at a time, on lines through the box of states.
class AxisErrors {
public:
  // Spreads lines over the box. Every third line runs along its edges and the others through the
  // inside, since errors of monotone laws are largest at the ends.
  AxisErrors(const Pieces& pieces, const std::vector<StateRange>& ranges, bool log_value,
             bool cubic);

  // Adds one line per axis, through this state.
  void add(const std::vector<double>& state);

  // Largest error of tau_R in MPa in the middle of each cell.
  std::vector<double> by_cell(const AxisPlan& plan, const TableAxis& axis) const;
  double largest(const AxisPlan& plan, std::size_t cells) const;

  // Fewest cells for which the error along the axis stays below `target`, assuming that the error
  // falls with the number of cells.
  std::size_t cells_for(const AxisPlan& plan, double target) const;

  // Makes nodes dense where the error of even spacing is large, so that all cells err alike (de
  // Boor's equidistribution, with measured errors). Keeps even spacing where that saves less than a
  // fifth of the nodes: even nodes are found without search.
  void distribute_nodes(AxisPlan& plan, double target) const;

private:
  std::vector<double> between(const TableAxis& axis, std::vector<double> nodes) const;

  const Pieces& pieces_;
  std::vector<std::vector<double>> lines_; // per state: one value per line
  bool log_value_;
  bool cubic_;
};

} // namespace frictab::table
