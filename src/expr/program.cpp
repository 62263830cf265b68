// Compiles a formula to a list of instructions and evaluates it over blocks of rows.
#include "expr/program.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <stdexcept>
#include <tuple>
#include <unordered_map>

#include "core/parallel.h"
#include "expr/arithmetic.h"
#include "expr/row_loops.h"

namespace frictab::expr {

namespace {

std::size_t index_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

} // namespace

Program::Program(const Expr& formula, std::vector<std::string> columns,
                 std::vector<std::string> scalars)
    : columns_(std::move(columns)), scalars_(std::move(scalars)) {
  // Computes the same operation on the same operands only once.
  using Same = std::tuple<Op, std::uint64_t, std::size_t, Kind, std::array<std::size_t, 4>>;
  std::map<Same, std::size_t> known;
  std::unordered_map<const Expr::Node*, std::size_t> index;
  inside_out(formula, [&](const Expr& e) {
    std::vector<std::size_t> operands;
    for (const Expr& operand : e.operands())
      operands.push_back(index.at(operand.id()));
    const Instruction next = instruction(e, operands);
    const Same same{next.op, std::bit_cast<std::uint64_t>(next.value), next.index, next.kind,
                    std::to_array(next.a)};
    const auto [at, is_new] = known.emplace(same, code_.size());
    if (is_new) code_.push_back(next);
    index.emplace(e.id(), at->second);
  });
  assign_slots();
  assign_steps();
}

// Reuses the slot of a result after its last use, so that the blocks of a long formula stay in the
// cache.
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

void Program::assign_steps() {
  std::vector<std::pair<Source, std::size_t>> found;
  for (const Instruction& in : code_) {
    if (in.op == Op::constant) {
      found.emplace_back(Source::constant, constants_.size());
      constants_.push_back(in.value);
    } else if (in.op == Op::symbol) {
      found.emplace_back(in.kind == Kind::data ? Source::row : Source::scalar, in.index);
    } else {
      found.emplace_back(Source::result, steps_.size());
      Step step{.op = in.op};
      for (std::size_t k = 0; k < 4; ++k) { // unused operands read the first one
        const auto& [source, index] = found[in.a[k < in.operands ? k : 0]];
        step.source[k] = source;
        step.index[k] = static_cast<std::uint32_t>(index);
      }
      steps_.push_back(step);
    }
  }
}

Program::Instruction Program::instruction(const Expr& e,
                                          std::span<const std::size_t> operands) const {
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
  for (const std::size_t index : operands) {
    const Instruction& from = code_[index];
    on_columns = on_columns || from.kind != Kind::scalar;
    on_scalars = on_scalars || from.kind == Kind::row ||
                 (from.kind == Kind::scalar && from.op != Op::constant);
    next.a[next.operands++] = index;
  }
  if (on_columns) next.kind = on_scalars ? Kind::row : Kind::data;
  return next;
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
  if (steps_.empty()) { // a single symbol or constant
    double alone = 0;
    forward(row, scalars, &alone);
    return alone;
  }
  double small[64];
  std::vector<double> large(steps_.size() > 64 ? steps_.size() : 0);
  double* result = large.empty() ? small : large.data();
  const double* const sources[] = {row.data(), scalars.data(), constants_.data(), result};
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    const auto operand = [&](std::size_t k) {
      return sources[static_cast<std::size_t>(step.source[k])][step.index[k]];
    };
    result[i] = step.op == Op::where_le
                    ? apply(step.op, operand(0), operand(1), operand(2), operand(3))
                    : apply(step.op, operand(0), operand(1), 0, 0);
  }
  return result[steps_.size() - 1];
}

double Program::gradient(std::span<const double> row, std::span<const double> scalars,
                         std::span<double> by_column) const {
  std::vector<double> work(2 * code_.size(), 0.0);
  double* v = work.data();
  double* adjoint = v + code_.size();
  forward(row, scalars, v);
  std::ranges::fill(by_column, 0.0);
  adjoint[code_.size() - 1] = 1;
  for (std::size_t i = code_.size(); i-- > 0;) {
    const Instruction& in = code_[i];
    if (adjoint[i] == 0) continue; // ignores an infinite slope of a branch not taken
    if (in.op == Op::symbol && in.kind == Kind::data) by_column[in.index] += adjoint[i];
    const double operands[4] = {v[in.a[0]], v[in.a[1]], v[in.a[2]], v[in.a[3]]};
    for (std::size_t k = 0; k < in.operands; ++k)
      adjoint[in.a[k]] += adjoint[i] * partial(in.op, k, operands, v[i]);
  }
  return v[code_.size() - 1];
}

namespace {

// Rows per operation when nothing is summed over them: enough that selecting a loop costs little,
// few enough that the slots stay in the cache.
constexpr std::size_t at_once = 512;

// Registers of one block; the caller fills in the scalars.
struct Workspace {
  std::vector<Register> registers;
  std::vector<double> storage;
  Workspace(std::size_t size, std::size_t slots) : registers(size), storage(slots * at_once) {}
  double* slot(std::size_t i) { return storage.data() + i * at_once; }
};

} // namespace

void Program::evaluate(std::size_t rows, std::span<const double* const> columns,
                       std::span<const double> scalars, double* out) const {
  const std::size_t blocks = (rows + at_once - 1) / at_once;
  constexpr std::size_t per_task = 8;
  parallel_for((blocks + per_task - 1) / per_task, [&](std::size_t task) {
    Workspace work(code_.size(), slots_);
    for (std::size_t b = task * per_task; b < std::min(blocks, (task + 1) * per_task); ++b) {
      const std::size_t first = b * at_once;
      const std::size_t n = std::min(at_once, rows - first);
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
          run_operation(in.op, count, operands, work.slot(slot_[i]));
          target = {work.slot(slot_[i]), in.kind == Kind::scalar ? std::size_t{0} : std::size_t{1}};
        }
      }
      const Register result = work.registers.back();
      for (std::size_t i = 0; i < n; ++i)
        out[first + i] = result[i];
    }
  });
}

} // namespace frictab::expr
