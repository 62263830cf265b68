// Largest difference between a table and its law over a box of states.
#pragma once

#include <functional>
#include <vector>

#include "expr/program.h"
#include "table/build.h"

namespace frictab::table {

// A law with its parameters, as a function of states in a given order.
class LawFunction {
public:
  LawFunction(const models::AssembledLaw& law, std::vector<std::string> columns);
  double operator()(std::span<const double> state) const { return program_(state, parameters_); }
  void evaluate(std::size_t rows, std::span<const double* const> columns, double* tau) const {
    program_.evaluate(rows, columns, parameters_, tau);
  }

private:
  expr::Program program_;
  std::vector<double> parameters_;
};

// States one after the other: one vector per range, in their order.
using States = std::vector<std::vector<double>>;

// Points that fill a box of states: `samples` Halton points, and all corners.
States box_points(const std::vector<StateRange>& ranges, std::size_t samples);

// All combinations of these values, one list per state; every n-th where there are more than
// `wanted`. n shares no factor with the lengths, so that each list is covered.
States grid_points(const States& values, std::size_t wanted);

// Centres of a table's cells, with the other states at their ends and middle: all of them, or about
// `wanted`, evenly spread, where there are more.
States cell_points(const std::vector<StateRange>& ranges, const std::vector<TableAxis>& axes,
                   std::size_t wanted);

// Both box_points and cell_points.
States probe_points(const std::vector<StateRange>& ranges, const std::vector<TableAxis>& axes,
                    std::size_t samples);

// States with the values of law and table (MPa).
struct Probe {
  States states;
  std::vector<double> law;
  std::vector<double> table;
  std::vector<unsigned> outside; // bits of table/outside.h, all_ends
};
Probe with_law(const LawFunction& law, States states); // leaves the table's values empty
// fills them in; returns the largest |table - law|
double compare(Probe& probed, const TableFunction& table);
void append(Probe& to, const Probe& from);
std::vector<double> state_of(const Probe& probed, std::size_t i);

struct WorstCase {
  double drift_MPa = 0;
  std::vector<double> state; // in the order of the ranges
  std::size_t points = 0;    // number of evaluations, ascent included
  States peaks;              // end points of the ascents
};

// Searches for the largest |table - law|: all probed states, then local ascent (NLopt SBPLX) from
// the `starts` worst. The result is found, not proven: the true maximum may be larger.
WorstCase worst_case(const LawFunction& law, const TableFunction& table,
                     const std::vector<StateRange>& ranges, const Probe& probed,
                     std::size_t starts = 64);
WorstCase worst_case(const LawFunction& law, const TableFunction& table,
                     const std::vector<StateRange>& ranges, const States& points);

} // namespace frictab::table
