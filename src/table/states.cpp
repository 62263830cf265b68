// States by name, checked against a table.
#include "table/states.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "io/number.h"

namespace frictab::table {

namespace {

[[noreturn]] void no_input(const std::string& name, const std::vector<std::string>& inputs) {
  throw InputError({}, fmt::format("'{}' is not a state of this table", name),
                   suggest(name, inputs));
}

std::string range_text(const Table& table, const std::string& name) {
  const auto range = table.range(name);
  return range ? fmt::format("{:g} .. {:g}", range->first, range->second) : "any";
}

} // namespace

FixedStates fixed_states(const std::vector<std::string>& texts,
                         const std::vector<std::string>& inputs) {
  FixedStates held;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    double value = std::nan("");
    const bool number = equals != text.npos &&
                        io::read_number(std::string_view(text).substr(equals + 1), '.', value);
    if (!number || !std::isfinite(value))
      throw InputError({}, fmt::format("'{}' is not a state", text),
                       "name=number, for example psi=2");
    if (std::ranges::find(inputs, name) == inputs.end()) no_input(name, inputs);
    if (!held.emplace(name, value).second)
      throw InputError({}, fmt::format("{} is given twice", name));
  }
  return held;
}

void check_input(const Table& table, const std::string& name) {
  const auto inputs = table.inputs();
  if (std::ranges::find(inputs, name) == inputs.end()) no_input(name, inputs);
}

const TableAxis* find_axis(const Table& table, const std::string& name) {
  for (const TableAxis& axis : table.axes)
    if (axis.name == name) return &axis;
  return nullptr;
}

std::vector<std::string> check_fixed_states(const Table& table, const FixedStates& held) {
  FaultList faults;
  std::vector<std::string> notes;
  for (const auto& [name, value] : held) {
    const auto range = table.range(name);
    if (!range || (value >= range->first && value <= range->second)) continue;
    if (find_axis(table, name))
      faults.add({}, fmt::format("{} = {:g} is outside the table", name, value),
                 fmt::format("its axis runs from {:g} to {:g}", range->first, range->second));
    else
      notes.push_back(
          fmt::format("{} = {:g} is not an axis and lies outside {:g} .. {:g}, for which the "
                      "table was verified",
                      name, value, range->first, range->second));
  }
  faults.throw_if_any();
  return notes;
}

std::vector<std::string> hold_others(const Table& table, const std::vector<std::string>& free,
                                     FixedStates& held) {
  std::vector<std::string> parts;
  for (const std::string& name : table.inputs()) {
    if (held.count(name) || std::ranges::find(free, name) != free.end()) continue;
    const TableAxis* axis = find_axis(table, name);
    const auto range = axis && axis->data ? axis->data : table.range(name);
    if (!range) continue;
    const auto [low, high] = *range;
    const bool log = axis && axis->log && low > 0;
    const double middle = log ? std::sqrt(low * high) : (low + high) / 2;
    // A text column has whole numbers.
    const bool levels = table.record.input(name).levels.has_value();
    const double rounded = levels ? std::floor(middle) : std::stod(fmt::format("{:.3g}", middle));
    held[name] = std::clamp(rounded, low, high);
    parts.push_back(fmt::format("{} = {:g}", name, held[name]));
  }
  if (parts.empty()) return {};
  return {"held in the middle of their range: " + join(parts, ", ") + "; --at sets them"};
}

void check_all_known(const Table& table, const FixedStates& held,
                     const std::vector<std::string>& free) {
  std::vector<std::string> missing, options;
  for (const std::string& name : table.inputs()) {
    if (held.count(name) || std::ranges::find(free, name) != free.end()) continue;
    const auto range = table.range(name);
    missing.push_back(fmt::format("{} ({})", name, range_text(table, name)));
    options.push_back(fmt::format("--at {}={:g}", name, range ? range->first : 1.0));
  }
  if (missing.empty()) return;
  throw InputError({}, "no value is given for " + join(missing, ", "), join(options, " "));
}

std::vector<double> evenly_spaced(const Table& table, const std::string& name, std::size_t count) {
  const auto range = table.range(name);
  if (!range)
    throw InputError({}, fmt::format("the range of {} is not known: it is not an axis", name),
                     fmt::format("--at {}=NUMBER", name));
  const TableAxis* axis = find_axis(table, name);
  const bool log = axis && axis->log;
  const auto [low, high] = *range;
  const double a = log ? std::log(low) : low, b = log ? std::log(high) : high;
  std::vector<double> values{low};
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double u = a + (b - a) * static_cast<double>(i) / static_cast<double>(count - 1);
    values.push_back(std::clamp(log ? std::exp(u) : u, low, high));
  }
  values.push_back(high);
  return values;
}

} // namespace frictab::table
