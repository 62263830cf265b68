// How far a table is from its law over a box of states.
#pragma once

#include <functional>
#include <vector>

#include "expr/program.h"
#include "table/build.h"

namespace frictab {

// A law with its parameters, as a function of states in a given order.
class LawFunction {
public:
  LawFunction(const Model& model, std::vector<std::string> columns);
  double operator()(std::span<const double> state) const { return program_(state, parameters_); }
  void evaluate(std::size_t rows, std::span<const double* const> columns, double* tau) const {
    program_.evaluate(rows, columns, parameters_, tau);
  }

private:
  Program program_;
  std::vector<double> parameters_;
};

// Points that fill a box of states: Halton points, corners, and - where a table's axes are given -
// the centres of its cells and the middles between nodes, with the other states at ends and middle.
// One vector per range, in their order.
std::vector<std::vector<double>> probe_points(const std::vector<StateRange>& ranges,
                                              const std::vector<TableAxis>& axes,
                                              std::size_t samples);

struct WorstCase {
  double drift_MPa = 0;
  std::vector<double> state; // in the order of the ranges
  std::size_t points = 0;    // evaluated, ascent included
};

// The largest |table - law| found: all probe points, then local ascent (NLopt SBPLX) from the
// worst. Found, not proven: the true maximum may be larger.
WorstCase worst_case(const LawFunction& law, const TableFunction& table,
                     const std::vector<StateRange>& ranges,
                     const std::vector<std::vector<double>>& points);

} // namespace frictab
