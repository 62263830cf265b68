// Compiles a formula to a list of instructions and sweeps it over blocks of rows.
#include "expr/program.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "core/parallel.h"
#include "expr/arithmetic.h"

namespace frictab {

namespace {

std::size_t index_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

// Derivative of an operation by operand `which`, given operand values and the result.
double partial(Op op, std::size_t which, const double* v, double result) {
  switch (op) {
  case Op::negate:
    return -1;
  case Op::add:
    return 1;
  case Op::subtract:
    return which == 0 ? 1 : -1;
  case Op::multiply:
    return which == 0 ? v[1] : v[0];
  case Op::divide:
    return which == 0 ? 1 / v[1] : -result / v[1];
  case Op::power:
    if (which == 0) return v[0] == 0 ? (v[1] == 1 ? 1 : 0) : v[1] * result / v[0];
    return v[0] > 0 ? result * std::log(v[0]) : 0;
  case Op::exp:
    return result;
  case Op::log:
    return 1 / v[0];
  case Op::sqrt:
    return 0.5 / result;
  case Op::sin:
    return std::cos(v[0]);
  case Op::tanh:
    return 1 - result * result;
  case Op::acos:
    return -1 / std::sqrt(1 - v[0] * v[0]);
  case Op::minimum:
    return (v[1] < v[0]) == (which == 1) ? 1 : 0;
  case Op::maximum:
    return (v[1] > v[0]) == (which == 1) ? 1 : 0;
  case Op::where_le:
    return which >= 2 && (v[0] <= v[1]) == (which == 2) ? 1 : 0;
  case Op::constant:
  case Op::symbol:
    break;
  }
  return 0;
}

// A register holds one value per row of the block, or one value for all rows (stride 0).
struct Register {
  const double* data = nullptr;
  std::size_t stride = 0;
  double operator[](std::size_t i) const { return data[i * stride]; }
};

template <class F> void unary(std::size_t n, Register a, double* out, F f) {
  for (std::size_t i = 0; i < n; ++i)
    out[i] = f(a[i]);
}

template <class F> void binary(std::size_t n, Register a, Register b, double* out, F f) {
  if (a.stride == 1 && b.stride == 1)
    for (std::size_t i = 0; i < n; ++i)
      out[i] = f(a.data[i], b.data[i]);
  else if (a.stride == 1)
    for (std::size_t i = 0; i < n; ++i)
      out[i] = f(a.data[i], *b.data);
  else
    for (std::size_t i = 0; i < n; ++i)
      out[i] = f(*a.data, b[i]);
}

void run_operation(Op op, std::size_t n, const Register* r, double* out) {
  switch (op) { // the cheap operations get loops the compiler vectorises
  case Op::add:
    return binary(n, r[0], r[1], out, [](double a, double b) { return a + b; });
  case Op::subtract:
    return binary(n, r[0], r[1], out, [](double a, double b) { return a - b; });
  case Op::multiply:
    return binary(n, r[0], r[1], out, [](double a, double b) { return a * b; });
  case Op::divide:
    return binary(n, r[0], r[1], out, [](double a, double b) { return a / b; });
  case Op::minimum:
    return binary(n, r[0], r[1], out, min_nan);
  case Op::maximum:
    return binary(n, r[0], r[1], out, max_nan);
  case Op::negate:
    return unary(n, r[0], out, [](double a) { return -a; });
  default:
    break;
  }
  for (std::size_t i = 0; i < n; ++i)
    out[i] = apply(op, r[0][i], r[1][i], r[2][i], r[3][i]);
}

const double zero = 0;

// What an operation reads; unused places read zero.
struct Operands {
  Register r[4] = {{&zero, 0}, {&zero, 0}, {&zero, 0}, {&zero, 0}};
};

} // namespace

Program::Program(const Expr& formula, std::vector<std::string> columns,
                 std::vector<std::string> scalars)
    : columns_(std::move(columns)), scalars_(std::move(scalars)) {
  std::vector<std::pair<const Expr::Node*, std::size_t>> seen;
  add(formula, seen);
  assign_slots();
}

// A result's place is free again behind its last use, so that the blocks of a long formula stay in
// the cache.
void Program::assign_slots() {
  std::vector<std::size_t> last(code_.size(), code_.size()), free;
  for (std::size_t i = 0; i < code_.size(); ++i)
    for (std::size_t k = 0; k < code_[i].operands; ++k)
      last[code_[i].a[k]] = i;
  slot_.assign(code_.size(), 0);
  for (std::size_t i = 0; i < code_.size(); ++i) {
    const Instruction& in = code_[i];
    if (in.op == Op::constant || in.op == Op::symbol) continue;
    if (free.empty()) free.push_back(slots_++);
    slot_[i] = free.back();
    free.pop_back();
    for (std::size_t k = 0; k < in.operands; ++k) {
      const Instruction& from = code_[in.a[k]];
      const bool first = std::find(in.a, in.a + k, in.a[k]) == in.a + k;
      if (first && last[in.a[k]] == i && from.op != Op::constant && from.op != Op::symbol)
        free.push_back(slot_[in.a[k]]);
    }
  }
}

std::size_t Program::add(const Expr& e,
                         std::vector<std::pair<const Expr::Node*, std::size_t>>& seen) {
  for (const auto& [node, index] : seen)
    if (node == e.id()) return index;
  Instruction next{.op = e.op(), .kind = Kind::scalar};
  if (e.op() == Op::constant) next.value = e.value();
  if (e.op() == Op::symbol) {
    const std::size_t column = index_of(columns_, e.name());
    const std::size_t scalar = index_of(scalars_, e.name());
    if (column == columns_.size() && scalar == scalars_.size())
      throw std::logic_error("formula has the unknown symbol '" + e.name() + "'");
    next.kind = column < columns_.size() ? Kind::data : Kind::scalar;
    next.index = column < columns_.size() ? column : scalar;
  }
  bool on_scalars = false, on_columns = false;
  for (const Expr& operand : e.operands()) {
    const std::size_t index = add(operand, seen);
    const Instruction& from = code_[index];
    on_columns = on_columns || from.kind != Kind::scalar;
    on_scalars = on_scalars || from.kind == Kind::row ||
                 (from.kind == Kind::scalar && from.op != Op::constant);
    next.a[next.operands++] = index;
  }
  if (on_columns) next.kind = on_scalars ? Kind::row : Kind::data;
  for (std::size_t i = 0; i < code_.size(); ++i) { // the same operation on the same operands
    const Instruction& other = code_[i];
    if (other.op == next.op && other.kind == next.kind && other.index == next.index &&
        std::equal(other.a, other.a + 4, next.a) && other.operands == next.operands &&
        (next.op != Op::constant ||
         (other.value == next.value && std::signbit(other.value) == std::signbit(next.value)))) {
      seen.emplace_back(e.id(), i);
      return i;
    }
  }
  code_.push_back(next);
  seen.emplace_back(e.id(), code_.size() - 1);
  return code_.size() - 1;
}

void Program::forward(std::span<const double> row, std::span<const double> scalars,
                      double* v) const {
  for (std::size_t i = 0; i < code_.size(); ++i) {
    const Instruction& in = code_[i];
    if (in.op == Op::constant)
      v[i] = in.value;
    else if (in.op == Op::symbol)
      v[i] = in.kind == Kind::data ? row[in.index] : scalars[in.index];
    else
      v[i] = apply(in.op, v[in.a[0]], v[in.a[1]], v[in.a[2]], v[in.a[3]]);
  }
}

double Program::operator()(std::span<const double> row, std::span<const double> scalars) const {
  double small[64];
  std::vector<double> large(code_.size() > 64 ? code_.size() : 0);
  double* v = large.empty() ? small : large.data();
  forward(row, scalars, v);
  return v[code_.size() - 1];
}

double Program::gradient(std::span<const double> row, std::span<const double> scalars,
                         std::span<double> by_column) const {
  std::vector<double> work(2 * code_.size(), 0.0);
  double* v = work.data();
  double* adjoint = v + code_.size();
  forward(row, scalars, v);
  std::fill(by_column.begin(), by_column.end(), 0.0);
  adjoint[code_.size() - 1] = 1;
  for (std::size_t i = code_.size(); i-- > 0;) {
    const Instruction& in = code_[i];
    if (adjoint[i] == 0) continue; // keeps an infinite slope of a branch not taken out
    if (in.op == Op::symbol && in.kind == Kind::data) by_column[in.index] += adjoint[i];
    const double operands[4] = {v[in.a[0]], v[in.a[1]], v[in.a[2]], v[in.a[3]]};
    for (std::size_t k = 0; k < in.operands; ++k)
      adjoint[in.a[k]] += adjoint[i] * partial(in.op, k, operands, v[i]);
  }
  return v[code_.size() - 1];
}

namespace {

// Registers of one block; scalars are filled by the caller.
struct Workspace {
  std::vector<Register> registers;
  std::vector<double> storage;
  Workspace(std::size_t size, std::size_t slots)
      : registers(size), storage(slots * Program::block) {}
  double* slot(std::size_t i) { return storage.data() + i * Program::block; }
};

} // namespace

void Program::evaluate(std::size_t rows, std::span<const double* const> columns,
                       std::span<const double> scalars, double* out) const {
  const std::size_t blocks = (rows + block - 1) / block;
  constexpr std::size_t per_task = 32;
  parallel_for((blocks + per_task - 1) / per_task, [&](std::size_t task) {
    Workspace work(code_.size(), slots_);
    for (std::size_t b = task * per_task; b < std::min(blocks, (task + 1) * per_task); ++b) {
      const std::size_t first = b * block;
      const std::size_t n = std::min(block, rows - first);
      for (std::size_t i = 0; i < code_.size(); ++i) {
        const Instruction& in = code_[i];
        Register& target = work.registers[i];
        if (in.op == Op::constant)
          target = {&in.value, 0};
        else if (in.op == Op::symbol)
          target = in.kind == Kind::data ? Register{columns[in.index] + first, 1}
                                         : Register{&scalars[in.index], 0};
        else {
          Operands operands;
          for (std::size_t k = 0; k < in.operands; ++k)
            operands.r[k] = work.registers[in.a[k]];
          const std::size_t count = in.kind == Kind::scalar ? 1 : n;
          run_operation(in.op, count, operands.r, work.slot(slot_[i]));
          target = {work.slot(slot_[i]), in.kind == Kind::scalar ? std::size_t{0} : std::size_t{1}};
        }
      }
      const Register result = work.registers.back();
      for (std::size_t i = 0; i < n; ++i)
        out[first + i] = result[i];
    }
  });
}

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
  for (std::size_t i = program.code_.size(); i-- > 0;) // what the wanted nodes are made of
    if (wanted[i])
      for (std::size_t k = 0; k < program.code_[i].operands; ++k)
        wanted[program.code_[i].a[k]] = true;
  for (std::size_t i = 0; i < program.code_.size(); ++i) {
    const auto& in = program.code_[i];
    if (!wanted[i] || in.kind != Kind::data || in.op == Op::symbol) continue;
    Operands operands;
    for (std::size_t k = 0; k < in.operands; ++k) {
      const auto& from = program.code_[in.a[k]];
      if (from.op == Op::constant)
        operands.r[k] = {&from.value, 0};
      else if (from.op == Op::symbol)
        operands.r[k] = {columns_[from.index], 1};
      else
        operands.r[k] = {cached_[in.a[k]].data(), 1};
    }
    cached_[i].resize(rows);
    run_operation(in.op, rows, operands.r, cached_[i].data());
  }
}

// One sweep over all blocks: values forward, derivatives by each scalar backward.
class BoundProgram::Sweep {
public:
  Sweep(const BoundProgram& bound, std::span<const double> scalars, bool derivatives)
      : bound_(bound), code_(bound.program_.code_), parameters_(bound.program_.scalars_.size()),
        work_(code_.size(), code_.size()), value_(code_.size()),
        slope_(code_.size() * parameters_) {
    evaluate_scalars(scalars);
    if (!derivatives) return;
    adjoint_.resize(code_.size() * block);
    gradient_.resize(parameters_ * block);
    touched_.resize(code_.size());
  }

  Block run(std::size_t first, std::size_t count) {
    forward(first, count);
    const std::size_t last = code_.size() - 1;
    if (work_.registers[last].stride == 0) { // a formula without columns
      std::fill_n(work_.slot(last), count, value_[last]);
      work_.registers[last] = {work_.slot(last), 1};
    }
    Block result{first, count, work_.registers[last].data, {}};
    if (adjoint_.empty()) return result;
    backward(count);
    for (std::size_t p = 0; p < parameters_; ++p)
      result.derivative.push_back(gradient_.data() + p * block);
    return result;
  }

private:
  using Kind = Program::Kind;
  static constexpr std::size_t block = Program::block;

  // Nodes without columns: once, with their derivatives by each parameter in forward mode.
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

  void forward(std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < code_.size(); ++i) {
      const auto& in = code_[i];
      const auto& cached = bound_.cached_[i];
      Register& target = work_.registers[i];
      if (in.kind == Kind::scalar)
        target = {&value_[i], 0};
      else if (in.op == Op::symbol)
        target = {bound_.columns_[in.index] + first, 1};
      else if (in.kind == Kind::data)
        target = {cached.empty() ? nullptr : cached.data() + first, 1};
      else {
        Operands operands;
        for (std::size_t k = 0; k < in.operands; ++k)
          operands.r[k] = work_.registers[in.a[k]];
        run_operation(in.op, count, operands.r, work_.slot(i));
        target = {work_.slot(i), 1};
      }
    }
  }

  void backward(std::size_t count) {
    std::fill(gradient_.begin(), gradient_.end(), 0.0);
    std::fill(touched_.begin(), touched_.end(), 0);
    const std::size_t last = code_.size() - 1;
    std::fill_n(adjoint_.data() + last * block, count, 1.0);
    touched_[last] = 1;
    for (std::size_t i = code_.size(); i-- > 0;) {
      const auto& in = code_[i];
      if (!touched_[i] || in.kind == Kind::data) continue;
      if (in.kind == Kind::scalar)
        add_to_gradient(i, count);
      else
        for (std::size_t k = 0; k < in.operands; ++k)
          pass_on(i, k, count);
    }
  }

  void add_to_gradient(std::size_t i, std::size_t count) {
    const double* a = adjoint_.data() + i * block;
    for (std::size_t p = 0; p < parameters_; ++p)
      if (const double s = slope_[i * parameters_ + p]; s != 0)
        for (std::size_t j = 0; j < count; ++j)
          gradient_[p * block + j] += a[j] * s;
  }

  // Adds the adjoint of node i, times its derivative by operand k, to that operand's adjoint.
  void pass_on(std::size_t i, std::size_t k, std::size_t count) {
    const auto& in = code_[i];
    const std::size_t to = in.a[k];
    if (code_[to].kind == Kind::data || code_[to].op == Op::constant) return;
    const double* a = adjoint_.data() + i * block;
    double* b = adjoint_.data() + to * block;
    if (!touched_[to]) std::fill_n(b, count, 0.0);
    touched_[to] = 1;
    if (in.op == Op::add || (in.op == Op::subtract && k == 0)) {
      for (std::size_t j = 0; j < count; ++j)
        b[j] += a[j];
      return;
    }
    if (in.op == Op::multiply) {
      const Register other = work_.registers[in.a[1 - k]];
      for (std::size_t j = 0; j < count; ++j)
        b[j] += a[j] * other[j];
      return;
    }
    Operands operands;
    for (std::size_t o = 0; o < in.operands; ++o)
      operands.r[o] = work_.registers[in.a[o]];
    const double* out = work_.registers[i].data;
    for (std::size_t j = 0; j < count; ++j) {
      if (a[j] == 0) continue; // keeps an infinite slope of a branch not taken out
      const double v[4] = {operands.r[0][j], operands.r[1][j], operands.r[2][j], operands.r[3][j]};
      b[j] += a[j] * partial(in.op, k, v, out[j]);
    }
  }

  const BoundProgram& bound_;
  const std::vector<Program::Instruction>& code_;
  std::size_t parameters_;
  Workspace work_;
  std::vector<double> value_;    // of scalar nodes
  std::vector<double> slope_;    // of scalar nodes, by parameter
  std::vector<double> adjoint_;  // per node and row of the block
  std::vector<double> gradient_; // per parameter and row of the block
  std::vector<char> touched_;
};

void BoundProgram::sweep(std::span<const double> scalars, bool derivatives,
                         const std::function<void(const Block&)>& take) const {
  Sweep sweep(*this, scalars, derivatives);
  for (std::size_t first = 0; first < rows_; first += Program::block)
    take(sweep.run(first, std::min(Program::block, rows_ - first)));
}

} // namespace frictab
