// A formula compiled for many rows: values and derivatives by one reverse sweep per block of rows.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "expr/expr.h"

namespace frictab::expr {

// Program of a formula whose symbols are either `columns` (one value per row) or `scalars` (one
// value for all rows).
class Program {
public:
  static constexpr std::size_t block = 128; // rows per sweep: the working set stays in L1

  // Throws std::logic_error if the formula has a symbol in neither list.
  Program(const Expr& formula, std::vector<std::string> columns, std::vector<std::string> scalars);

  const std::vector<std::string>& columns() const { return columns_; }
  const std::vector<std::string>& scalars() const { return scalars_; }

  // Evaluates one row. `row` and `scalars` are in the order of the lists above.
  double operator()(std::span<const double> row, std::span<const double> scalars) const;

  // Evaluates one row and its derivatives by each column, in one reverse sweep.
  double gradient(std::span<const double> row, std::span<const double> scalars,
                  std::span<double> by_column) const;

  // Evaluates all rows: out[i] for i < rows; columns[c][i]. Runs in parallel; the result does not
  // depend on the thread count.
  void evaluate(std::size_t rows, std::span<const double* const> columns,
                std::span<const double> scalars, double* out) const;

private:
  friend class BoundProgram;
  enum class Kind : std::uint8_t { scalar, data, row }; // depends on: scalars only, columns, both
  struct Instruction {
    Op op;
    Kind kind;
    double value = 0;      // of a constant
    std::size_t index = 0; // of a symbol, in its list
    std::size_t a[4] = {}; // operands
    std::size_t operands = 0;
  };
  // One operation for single rows, with the source of each operand.
  enum class Source : std::uint8_t { row, scalar, constant, result };
  struct Step {
    Op op;
    Source source[4] = {};
    std::uint32_t index[4] = {};
  };
  void assign_slots();
  void assign_steps();
  void forward(std::span<const double> row, std::span<const double> scalars, double* v) const;
  Instruction instruction(const Expr& e, std::span<const std::size_t> operands) const;

  std::vector<Instruction> code_;
  std::vector<Step> steps_; // the operations of code_; constants and symbols are read in place
  std::vector<double> constants_;
  std::vector<std::size_t> slot_; // per instruction: slot of its result in `evaluate`
  std::size_t slots_ = 0;
  std::vector<std::string> columns_;
  std::vector<std::string> scalars_;
};

// A program bound to columns, which must outlive it: subformulas of columns only (logarithms of
// pressures, ...) are computed once, so that each calibration step computes only what changes.
class BoundProgram {
public:
  BoundProgram(const Program& program, std::size_t rows, std::span<const double* const> columns);

  std::size_t rows() const { return rows_; }

  // Result for one block: rows first .. first+count-1, their values and, per scalar, their
  // derivatives (derivative[s][i]). `sweep` calls `take` once per block, in row order.
  struct Block {
    std::size_t first;
    std::size_t count;
    const double* value;
    std::span<const double* const> derivative; // empty unless requested
  };
  void sweep(std::span<const double> scalars, bool derivatives,
             const std::function<void(const Block&)>& take) const;

private:
  class Sweep;
  const Program& program_;
  std::size_t rows_;
  std::vector<const double*> columns_;
  std::vector<std::vector<double>> cached_; // per instruction, for data nodes used by row nodes
};

} // namespace frictab::expr
