// Compiles a formula to a list of instructions and evaluates it over blocks of rows.
#include "expr/program.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "core/parallel.h"
#include "expr/arithmetic.h"
#include "expr/row_loops.h"

namespace frictab {

namespace {

std::size_t index_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

} // namespace

Program::Program(const Expr& formula, std::vector<std::string> columns,
                 std::vector<std::string> scalars)
    : columns_(std::move(columns)), scalars_(std::move(scalars)) {
  std::vector<std::pair<const Expr::Node*, std::size_t>> seen;
  add(formula, seen);
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

double Program::operator()(std::span<const double> row, std::span<const double> scalars) const {
  double small[64];
  std::vector<double> large(code_.size() > 64 ? code_.size() : 0);
  double* v = large.empty() ? small : large.data();
  for (std::size_t i = 0; i < code_.size(); ++i) {
    const Instruction& in = code_[i];
    if (in.op == Op::constant)
      v[i] = in.value;
    else if (in.op == Op::symbol)
      v[i] = in.kind == Kind::data ? row[in.index] : scalars[in.index];
    else
      v[i] = apply(in.op, v[in.a[0]], v[in.a[1]], v[in.a[2]], v[in.a[3]]);
  }
  return v[code_.size() - 1];
}

namespace {

// Registers of one block; scalars are filled by the caller.
struct Workspace {
  std::vector<Register> registers;
  std::vector<double> storage;
  explicit Workspace(std::size_t size) : registers(size), storage(size * Program::block) {}
  double* slot(std::size_t i) { return storage.data() + i * Program::block; }
};

} // namespace

void Program::evaluate(std::size_t rows, std::span<const double* const> columns,
                       std::span<const double> scalars, double* out) const {
  const std::size_t blocks = (rows + block - 1) / block;
  constexpr std::size_t per_task = 32;
  parallel_for((blocks + per_task - 1) / per_task, [&](std::size_t task) {
    Workspace work(code_.size());
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
          run_operation(in.op, count, operands, work.slot(i));
          target = {work.slot(i), in.kind == Kind::scalar ? std::size_t{0} : std::size_t{1}};
        }
      }
      const Register result = work.registers.back();
      for (std::size_t i = 0; i < n; ++i)
        out[first + i] = result[i];
    }
  });
}

} // namespace frictab
