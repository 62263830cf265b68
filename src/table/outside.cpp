// Evaluates the law's own formula beyond the ends of a table's axes.
#include "table/outside.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "table/states.h"

namespace frictab::table {

using expr::Expr;

namespace {

constexpr double no_end = std::numeric_limits<double>::infinity();

const std::pair<Outside, const char*> outside_words[] = {
    {Outside::clamp, "clamp"}, {Outside::error, "error"}, {Outside::law, "law"}};

// Name of the clamped axis in the extension: a second symbol in addition to the true state.
std::string held_name(const std::string& axis) {
  return "held " + axis;
}

} // namespace

const char* outside_name(Outside outside) {
  return outside_words[static_cast<std::size_t>(outside)].second;
}

std::optional<Outside> find_outside(std::string_view name) {
  for (const auto& [outside, known] : outside_words)
    if (name == known) return outside;
  return std::nullopt;
}

Outside usual_below(std::string_view axis) {
  return axis == "sigma_n_MPa" ? Outside::law : Outside::clamp;
}

Outside below_pressures(const Table& table) {
  const TableAxis* axis = find_axis(table, "sigma_n_MPa");
  return axis ? axis->below : Outside::law;
}

AxisEnds::AxisEnds(const TableAxis& axis, std::size_t number_of_input)
    : name(axis.name), input(number_of_input), low(axis.nodes.front()), high(axis.nodes.back()),
      below(axis.below), above(axis.above),
      refused_below(below == Outside::error ? low - end_rounding * std::abs(low) : -no_end),
      refused_above(above == Outside::error ? high + end_rounding * std::abs(high) : no_end) {}

AxisEnds::AxisEnds(const std::string& held_input, std::size_t number_of_input,
                   std::pair<double, double> range)
    : name(held_input), input(number_of_input), low(range.first), high(range.second),
      below(Outside::clamp), above(Outside::clamp), clamped_by_law(true), refused_below(-no_end),
      refused_above(no_end) {}

namespace {

// minimum(maximum(x, low), high), in any order of the operands; nullopt for other expressions.
struct Hold {
  std::string name;
  double low, high;
};

std::optional<Hold> hold_of(const Expr& e) {
  const auto parts = [](const Expr& of, expr::Op op) -> std::optional<std::pair<Expr, double>> {
    if (of.op() != op) return std::nullopt;
    for (const std::size_t i : {0U, 1U})
      if (of.operands()[i].op() == expr::Op::constant)
        return std::pair{of.operands()[1 - i], of.operands()[i].value()};
    return std::nullopt;
  };
  const auto upper = parts(e, expr::Op::minimum);
  const auto lower = upper ? parts(upper->first, expr::Op::maximum) : std::nullopt;
  if (!lower || lower->first.op() != expr::Op::symbol) return std::nullopt;
  return Hold{lower->first.name(), lower->second, upper->second};
}

// Returns the narrowest range to which the formula clamps each of its inputs.
std::map<std::string, std::pair<double, double>> held_ranges(const Expr& formula) {
  std::map<std::string, std::pair<double, double>> ranges;
  expr::for_each_part(formula, [&](const Expr& part) {
    const auto hold = hold_of(part);
    if (!hold) return;
    auto& [low, high] = ranges.try_emplace(hold->name, hold->low, hold->high).first->second;
    low = std::max(low, hold->low);
    high = std::min(high, hold->high);
  });
  return ranges;
}

} // namespace

std::vector<AxisEnds> clamped_input_ends(const Table& table) {
  std::map<std::string, std::pair<double, double>> ranges = held_ranges(table.combine);
  for (const auto& [name, record] : table.record.inputs)
    if (record.levels && record.low && record.high)
      ranges.try_emplace(name, *record.low, *record.high);
  const std::vector<std::string> inputs = table.inputs();
  std::vector<AxisEnds> ends;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto range = ranges.find(inputs[i]);
    if (range != ranges.end() && !find_axis(table, inputs[i]))
      ends.emplace_back(inputs[i], i, range->second);
  }
  return ends;
}

std::vector<AxisEnds> all_ends(const Table& table) {
  std::vector<AxisEnds> ends = axis_ends(table);
  for (AxisEnds& held : clamped_input_ends(table))
    ends.push_back(std::move(held));
  return ends;
}

std::vector<AxisEnds> axis_ends(const Table& table) {
  const std::vector<std::string> inputs = table.inputs();
  std::vector<AxisEnds> ends;
  for (const TableAxis& axis : table.axes) {
    const auto at = std::ranges::find(inputs, axis.name);
    ends.emplace_back(axis, static_cast<std::size_t>(at - inputs.begin()));
  }
  return ends;
}

bool OutsideRule::needed(const Table& table) {
  return table.is_direct() || std::ranges::any_of(table.axes, [](const TableAxis& axis) {
           return axis.below != Outside::clamp || axis.above != Outside::clamp;
         });
}

OutsideRule::OutsideRule(const Table& table) : direct_(table.is_direct()), ends_(axis_ends(table)) {
  if (!table.extension) return; // such a table can only refuse
  std::vector<std::string> row = table.inputs(), scalars;
  std::map<std::string, Expr> held;
  for (const AxisEnds& axis : ends_) {
    row.push_back(held_name(axis.name));
    held.emplace(axis.name, Expr::symbol(held_name(axis.name)));
  }
  for (const auto& [name, value] : table.constants) {
    scalars.push_back(name);
    constants_.push_back(value);
  }
  const Expr value = substitute(*table.extension, held);
  law_ =
      std::make_unique<expr::Program>(substitute(table.combine, {{"value", value}}), row, scalars);
}

OutsideRule::Answer OutsideRule::prepare(std::span<const double> state, double* row,
                                         unsigned* outside) const {
  unsigned bits = 0;
  bool law = direct_, refused = false;
  std::ranges::copy(state, row);
  for (std::size_t a = 0; a < ends_.size(); ++a) {
    const double x = state[ends_[a].input];
    if (ends_[a].leaves(x)) bits |= 1u << a;
    law = law || ends_[a].extends(x);
    refused = refused || ends_[a].refuses(x);
    row[state.size() + a] = ends_[a].asked_at(x);
  }
  if (outside) *outside = bits;
  return refused ? Answer::none : law ? Answer::law : Answer::table;
}

std::optional<double> OutsideRule::tau(std::span<const double> state, unsigned* outside) const {
  double row[2 * most_inputs];
  const Answer answer = prepare(state, row, outside);
  if (answer == Answer::table) return std::nullopt;
  const bool missing = std::ranges::any_of(state, [](double x) { return std::isnan(x); });
  if (answer == Answer::none || missing) return std::nan("");
  return (*law_)({row, state.size() + ends_.size()}, constants_);
}

std::optional<double> OutsideRule::gradient(std::span<const double> state,
                                            std::span<double> derivative, unsigned* outside) const {
  double row[2 * most_inputs], by_row[2 * most_inputs];
  const Answer answer = prepare(state, row, outside);
  if (answer == Answer::table) return std::nullopt;
  if (answer == Answer::none) {
    std::ranges::fill(derivative, std::nan(""));
    return std::nan("");
  }
  const std::size_t inputs = state.size(), size = inputs + ends_.size();
  const double tau = law_->gradient({row, size}, constants_, std::span<double>(by_row, size));
  std::copy(by_row, by_row + inputs, derivative.begin());
  for (std::size_t a = 0; a < ends_.size(); ++a) {
    const double x = state[ends_[a].input];
    if (ends_[a].asked_at(x) == x) derivative[ends_[a].input] += by_row[inputs + a];
  }
  return tau;
}

} // namespace frictab::table
