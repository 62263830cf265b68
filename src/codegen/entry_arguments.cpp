// Names arguments after state and unit, each once.
#include "codegen/entry_arguments.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <stdexcept>

#include "core/text.h"
#include "data/meaning.h"
#include "data/quantity.h"

namespace frictab::codegen {

namespace {

std::string replace_ending(const std::string& name, std::string_view from, std::string_view to) {
  if (name.size() <= from.size() || name.substr(name.size() - from.size()) != from) return name;
  return name.substr(0, name.size() - from.size()) + std::string(to);
}

// Fortran allows 63 letters, including those that are added.
constexpr std::size_t longest_argument = 40;

// Makes an identifier from a column's name, which may contain any characters; the prefix avoids
// collisions with keywords and generated names.
std::string identifier(const std::string& name) {
  std::string text = data::find_quantity(name) ? "" : "in_";
  for (const char c : name)
    text += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return text.substr(0, longest_argument);
}

std::string argument_name(const InputArgument& input) {
  return replace_ending(identifier(input.name), "_" + unit_suffix(input.unit),
                        "_" + unit_suffix(input.solver.name));
}

InputArgument argument(const table::Table& table, const std::string& name,
                       const SolverUnits& units) {
  InputArgument input;
  const data::Meaning meaning = data::meaning_of(name);
  input.name = name;
  input.unit = meaning.unit;
  input.meaning = meaning.text;
  for (std::size_t a = 0; a < table.axes.size(); ++a) {
    if (table.axes[a].name != name) continue;
    input.axis = a;
    input.unit = table.axes[a].unit;
    if (!table.axes[a].long_name.empty()) input.meaning = table.axes[a].long_name;
  }
  if (data::find_quantity(name)) { // the axis may have another name for it
    input.unit = meaning.unit;
    input.meaning = meaning.text;
  }
  const auto& recorded = table.record.input(name).long_name;
  if (input.meaning == data::Meaning{}.text)
    input.meaning = recorded && *recorded != input.meaning ? *recorded : name + " " + input.meaning;
  if (const auto& levels = table.record.input(name).levels) input.meaning = name + ": " + *levels;
  input.solver = solver_unit(input.unit, units);
  input.argument = argument_name(input);
  return input;
}

} // namespace

std::vector<InputArgument> entry_arguments(const table::Table& table, const SolverUnits& units) {
  std::vector<InputArgument> arguments;
  std::set<std::string> taken;
  const std::vector<std::string> needed = table.inputs();
  for (const data::Quantity& quantity : data::quantities())
    if (quantity.argument) arguments.push_back(argument(table, quantity.name, units));
  for (const std::string& name : needed) {
    const auto same = [&](const InputArgument& a) { return a.name == name; };
    const auto found = std::find_if(arguments.begin(), arguments.end(), same);
    if (found == arguments.end())
      arguments.push_back(argument(table, name, units)), arguments.back().used = true;
    else
      found->used = true;
  }
  // Fortran does not distinguish capital from small letters.
  for (InputArgument& a : arguments) {
    const std::string first = a.argument;
    for (int n = 2; !taken.insert(lower_case(a.argument)).second; ++n)
      a.argument = first + "_" + std::to_string(n);
  }
  return arguments;
}

const InputArgument& argument_named(const std::vector<InputArgument>& arguments,
                                    const std::string& name) {
  const auto found = std::find_if(arguments.begin(), arguments.end(),
                                  [&](const InputArgument& one) { return one.name == name; });
  if (found == arguments.end()) throw std::logic_error("no argument " + name);
  return *found;
}

std::optional<std::size_t> input_index(const table::Table& table, const std::string& name) {
  const std::vector<std::string> inputs = table.inputs();
  const auto at = std::find(inputs.begin(), inputs.end(), name);
  if (at == inputs.end()) return std::nullopt;
  return static_cast<std::size_t>(at - inputs.begin());
}

std::size_t inputs_size(const table::Table& table) {
  return std::max<std::size_t>(table.inputs().size(), 1);
}

std::optional<double> typical_value(const table::Table& table, const std::string& name) {
  const auto range = table.range(name);
  if (!range) return std::nullopt;
  if (table.record.input(name).levels) return range->first; // the level whose factor is 1
  bool log = data::meaning_of(name).log_axis;
  for (const table::TableAxis& axis : table.axes)
    if (axis.name == name) log = axis.log;
  const auto [low, high] = *range;
  return log && low > 0 ? std::sqrt(low) * std::sqrt(high) : 0.5 * (low + high);
}

} // namespace frictab::codegen
