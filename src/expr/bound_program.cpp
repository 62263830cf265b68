// Sweeps of a program over the columns bound to it: values forward, derivatives backward.
#include <algorithm>
#include <array>

#include "expr/arithmetic.h"
#include "expr/program.h"
#include "expr/row_loops.h"

namespace frictab::expr {

BoundProgram::BoundProgram(const Program& program, std::size_t rows,
                           std::span<const double* const> columns)
    : program_(program), rows_(rows), columns_(columns.begin(), columns.end()),
      cached_(program.code_.size()) {
  using Kind = Program::Kind;
  std::vector<bool> wanted(program.code_.size(), false);
  for (const auto& in : program.code_)
    if (in.kind == Kind::row)
      for (std::size_t k = 0; k < in.operands; ++k)
        wanted[in.a[k]] = program.code_[in.a[k]].kind == Kind::data || wanted[in.a[k]];
  wanted.back() = program.code_.back().kind == Kind::data || wanted.back();
  const std::vector<bool> kept = wanted;
  for (std::size_t i = program.code_.size(); i-- > 0;) // inputs of the kept nodes
    if (wanted[i])
      for (std::size_t k = 0; k < program.code_[i].operands; ++k)
        wanted[program.code_[i].a[k]] = true;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < program.code_.size(); ++i)
    if (wanted[i] && program.code_[i].kind == Kind::data && program.code_[i].op != Op::symbol) {
      order.push_back(i);
      if (kept[i]) cached_[i].resize(rows);
    }
  std::vector<double> passing(order.empty() ? 0 : program.code_.size() * Program::block);
  for (std::size_t first = 0; first < rows; first += Program::block)
    for (const std::size_t i : order) {
      const auto& in = program.code_[i];
      const auto rows_of = [&](std::size_t node) {
        return kept[node] ? cached_[node].data() + first : passing.data() + node * Program::block;
      };
      Operands operands;
      for (std::size_t k = 0; k < in.operands; ++k) {
        const auto& from = program.code_[in.a[k]];
        if (from.op == Op::constant)
          operands.r[k] = {&from.value, 0};
        else if (from.op == Op::symbol)
          operands.r[k] = {columns_[from.index] + first, 1};
        else
          operands.r[k] = {rows_of(in.a[k]), 1};
      }
      run_operation(in.op, std::min(Program::block, rows - first), operands, rows_of(i));
    }
}

// One sweep over all blocks. Derivatives by reverse accumulation: an operation that leaves an
// adjoint unchanged passes it on as a pointer; an adjoint gets rows of its own only when a second
// contribution is added to it.
class BoundProgram::Sweep {
public:
  Sweep(const BoundProgram& bound, std::span<const double> scalars, bool derivatives)
      : bound_(bound), code_(bound.program_.code_), parameters_(bound.program_.scalars_.size()),
        derivatives_(derivatives), registers_(code_.size()), value_(code_.size()),
        slope_(code_.size() * parameters_), gradient_(parameters_),
        rows_(new double[(code_.size() * (derivatives ? 2 : 1) + parameters_) * block]) {
    evaluate_scalars(scalars);
    if (derivatives) adjoint_.resize(code_.size());
  }

  Block run(std::size_t first, std::size_t count) {
    forward(first, count);
    const std::size_t last = code_.size() - 1;
    if (registers_[last].stride == 0) { // a formula without columns
      std::fill_n(value_slot(last), count, value_[last]);
      registers_[last] = {value_slot(last), 1};
    }
    if (derivatives_) backward(count);
    return {first, count, registers_[last].data,
            derivatives_ ? std::span<const double* const>(gradient_)
                         : std::span<const double* const>()};
  }

private:
  using Kind = Program::Kind;
  static constexpr std::size_t block = Program::block;

  double* value_slot(std::size_t i) { return rows_.get() + i * block; }
  double* adjoint_slot(std::size_t i) { return rows_.get() + (code_.size() + i) * block; }
  double* gradient_slot(std::size_t p) { return rows_.get() + (2 * code_.size() + p) * block; }

  // Evaluates the nodes without columns once, with their derivatives by each parameter in forward
  // mode.
  void evaluate_scalars(std::span<const double> scalars) {
    for (std::size_t i = 0; i < code_.size(); ++i) {
      const auto& in = code_[i];
      if (in.op == Op::constant) value_[i] = in.value;
      if (in.kind != Kind::scalar || in.op == Op::constant) continue;
      if (in.op == Op::symbol) {
        value_[i] = scalars[in.index];
        slope_[i * parameters_ + in.index] = 1;
        continue;
      }
      double v[4] = {};
      for (std::size_t k = 0; k < in.operands; ++k)
        v[k] = value_[in.a[k]];
      value_[i] = apply(in.op, v[0], v[1], v[2], v[3]);
      for (std::size_t k = 0; k < in.operands; ++k)
        for (std::size_t p = 0; p < parameters_; ++p)
          if (const double s = slope_[in.a[k] * parameters_ + p]; s != 0)
            slope_[i * parameters_ + p] += partial(in.op, k, v, value_[i]) * s;
    }
  }

  Operands operands_of(const Program::Instruction& in) const {
    Operands operands;
    for (std::size_t k = 0; k < in.operands; ++k)
      operands.r[k] = registers_[in.a[k]];
    return operands;
  }

  void forward(std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < code_.size(); ++i) {
      const auto& in = code_[i];
      const auto& cached = bound_.cached_[i];
      Register& target = registers_[i];
      if (in.kind == Kind::scalar)
        target = {&value_[i], 0};
      else if (in.op == Op::symbol)
        target = {bound_.columns_[in.index] + first, 1};
      else if (in.kind == Kind::data)
        target = {cached.empty() ? nullptr : cached.data() + first, 1};
      else {
        run_operation(in.op, count, operands_of(in), value_slot(i));
        target = {value_slot(i), 1};
      }
    }
  }

  static const double* constant_rows(double value) {
    const auto filled = [](double x) {
      std::array<double, block> rows;
      rows.fill(x);
      return rows;
    };
    static const std::array<double, block> ones = filled(1), zeros = filled(0);
    return value == 1 ? ones.data() : zeros.data();
  }

  void backward(std::size_t count) {
    std::ranges::fill(gradient_, nullptr);
    std::ranges::fill(adjoint_, nullptr);
    adjoint_.back() = constant_rows(1);
    for (std::size_t i = code_.size(); i-- > 0;) {
      const auto& in = code_[i];
      if (!adjoint_[i] || in.kind == Kind::data) continue;
      if (in.kind == Kind::scalar)
        add_to_gradient(i, count);
      else
        for (std::size_t k = 0; k < in.operands; ++k)
          pass_on(i, k, count);
    }
    for (const double*& g : gradient_)
      if (!g) g = constant_rows(0);
  }

  void add_to_gradient(std::size_t i, std::size_t count) {
    const double* a = adjoint_[i];
    for (std::size_t p = 0; p < parameters_; ++p) {
      const double s = slope_[i * parameters_ + p];
      if (s == 0) continue;
      if (!gradient_[p] && s == 1) {
        gradient_[p] = a;
        continue;
      }
      double* to = gradient_slot(p);
      const bool add = own(gradient_[p], to, count);
      pass_back(Op::multiply, 0, count, {{{}, {&s, 0}, {}, {}}}, nullptr, a, to, add);
    }
  }

  // Adds the adjoint of node i, times its derivative by operand k, to that operand's adjoint.
  void pass_on(std::size_t i, std::size_t k, std::size_t count) {
    const auto& in = code_[i];
    const std::size_t to = in.a[k];
    if (code_[to].kind == Kind::data || code_[to].op == Op::constant) return;
    if (in.op == Op::where_le && k < 2) return; // a condition has no slope
    const bool unchanged = in.op == Op::add || (in.op == Op::subtract && k == 0);
    if (unchanged && !adjoint_[to]) {
      adjoint_[to] = adjoint_[i];
      return;
    }
    const bool add = own(adjoint_[to], adjoint_slot(to), count);
    pass_back(in.op, k, count, operands_of(in), registers_[i].data, adjoint_[i], adjoint_slot(to),
              add);
  }

  // Gives a sum rows of its own; returns whether it already has contributions.
  static bool own(const double*& sum, double* slot, std::size_t count) {
    const bool add = sum != nullptr;
    if (add && sum != slot) std::copy_n(sum, count, slot);
    sum = slot;
    return add;
  }

  const BoundProgram& bound_;
  const std::vector<Program::Instruction>& code_;
  std::size_t parameters_;
  bool derivatives_;
  std::vector<Register> registers_;
  std::vector<double> value_;           // of scalar nodes
  std::vector<double> slope_;           // of scalar nodes, by parameter
  std::vector<const double*> adjoint_;  // per node; nullptr: no contribution yet
  std::vector<const double*> gradient_; // per parameter
  std::unique_ptr<double[]> rows_;      // values, adjoints, gradients
};

void BoundProgram::sweep(std::span<const double> scalars, bool derivatives,
                         const std::function<void(const Block&)>& take) const {
  Sweep sweep(*this, scalars, derivatives);
  for (std::size_t first = 0; first < rows_; first += Program::block)
    take(sweep.run(first, std::min(Program::block, rows_ - first)));
}

} // namespace frictab::expr
