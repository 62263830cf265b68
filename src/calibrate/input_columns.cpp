// Finds recorded columns, derives histories, and iterates those that need the law's own stress.
#include "calibrate/input_columns.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "data/condense.h"
#include "data/derived.h"
#include "effects/extended_law.h"
#include "expr/program.h"

namespace frictab::calibrate {

using data::Dataset;

namespace {

constexpr double settled_change = 1e-12; // relative change between two rounds
constexpr int plain_rounds = 20, most_rounds = 400;

// Finds a recorded column; one with the name of a history does not count.
const data::Column* recorded_column(const std::string& name, const Dataset& data) {
  if (data::find_derived(name)) return nullptr;
  if (const data::Column* column = data.find(name)) return column;
  for (const data::Column& column : data.columns)
    if (effects::symbol_of(column.name) == name) return &column;
  return nullptr;
}

// Columns that a history needs and the data lack.
std::vector<std::string> missing_needs(const data::DerivedQuantity& derived, const Dataset& data) {
  std::vector<std::string> names;
  for (const std::string& need : derived.needs)
    if (need != "tau" && !data.has(need)) names.push_back(need);
  return names;
}

bool follows_tau(const std::string& name) {
  const data::DerivedQuantity* derived = data::find_derived(name);
  return derived && std::ranges::count(derived->needs, "tau") > 0;
}

Place place_of(const Dataset& data) {
  return {join(data.sources, ", "), 0, 0};
}

// Numbers a text column by the law's levels, because files number only the levels that they
// contain.
std::vector<double> renumbered(const data::Column& column, const std::vector<std::string>& levels,
                               const Dataset& data) {
  if (data::is_empty(column)) { // empty in these rows, but a text column
    data::Column text = column;
    data::make_empty_text(text);
    return renumbered(text, levels, data);
  }
  if (column.levels.empty())
    throw InputError(place_of(data), "column " + column.name + " holds numbers",
                     "the law knows its levels by name: " + join(levels, ", "));
  std::vector<double> numbers;
  for (const std::string& level : column.levels) {
    const auto at = std::ranges::find(levels, level);
    if (at == levels.end())
      throw InputError(place_of(data),
                       fmt::format("column {} has the level '{}', of which the law knows nothing",
                                   column.name, level),
                       "known: " + join(levels, ", "));
    numbers.push_back(static_cast<double>(at - levels.begin()));
  }
  std::vector<double> values;
  for (const double number : column.values)
    values.push_back(numbers[static_cast<std::size_t>(number)]);
  return values;
}

// Example: "row 3 of 'E1'"
std::string row_name(const Dataset& data, std::size_t row) {
  const auto next = std::ranges::upper_bound(data.first_row, row) - 1;
  const auto e = static_cast<std::size_t>(next - data.first_row.begin());
  return fmt::format("row {} of '{}'", row - data.first_row[e] + 1, data.experiments[e]);
}

// Rows whose value is not a number.
struct NoNumbers {
  std::size_t first = 0, count = 0;

  explicit NoNumbers(const std::vector<double>& values) {
    for (std::size_t row = values.size(); row-- > 0;)
      if (!std::isfinite(values[row])) first = row, ++count;
  }
  // Example: "row 3 of 'E1' and 7 more"
  std::string text(const Dataset& data) const {
    const std::string name = row_name(data, first);
    return count > 1 ? name + " and " + thousands(count - 1) + " more" : name;
  }
};

// Rejects empty cells: without a value of a state, laws have no stress and fits no sum.
void check_cells(const data::Column& column, const models::Law& law, const Dataset& data) {
  const NoNumbers empty(column.values);
  if (empty.count == 0) return;
  throw InputError(
      place_of(data),
      fmt::format("{} is empty in {}, and {} needs it", column.name, empty.text(data), law.name),
      "repair the cell; in a job data.missing = \"drop\" leaves such rows out of the calibration");
}

std::string how_to_give(const models::Law& law, const std::vector<std::string>& names,
                        const Dataset& data) {
  const bool text = std::ranges::any_of(names, [&](const std::string& name) {
    return law.levels.count(name) > 0 && !recorded_column(name, data);
  });
  return text ? "record it, map it in [data.columns], or say it with labels = {...} of "
                "[[data.files]]"
              : "record it, map it in [data.columns], or give a constant in [data.constants]";
}

} // namespace

std::vector<std::string> missing_inputs(const std::vector<std::string>& names,
                                        const Dataset& data) {
  std::vector<std::string> missing;
  for (const std::string& name : names) {
    if (recorded_column(name, data)) continue;
    const data::DerivedQuantity* derived = data::find_derived(name);
    const auto from = derived ? missing_needs(*derived, data) : std::vector<std::string>{};
    if (!derived)
      missing.push_back(name);
    else if (!from.empty())
      missing.push_back(fmt::format("{} (from {})", name, join(from, ", ")));
  }
  return missing;
}

InputColumns::InputColumns(const models::Law& law, std::vector<std::string> names,
                           const Dataset& data)
    : data_(&data), names_(std::move(names)), own_(names_.size()), follows_(names_.size()) {
  if (const auto missing = missing_inputs(names_, data); !missing.empty())
    throw InputError(
        place_of(data),
        fmt::format("the data have no column {}, which {} needs", join(missing, ", "), law.name),
        how_to_give(law, names_, data));
  for (std::size_t i = 0; i < names_.size(); ++i) {
    follows_[i] = follows_tau(names_[i]);
    pointers_.push_back(find(law, i));
  }
}

const double* InputColumns::find(const models::Law& law, std::size_t input) {
  const std::string& name = names_[input];
  const data::Column* column = recorded_column(name, *data_);
  const auto levels = law.levels.find(name);
  if (column && levels == law.levels.end()) {
    if (!column->levels.empty()) {
      const auto& all = column->levels; // the first level may stand for empty cells
      const std::string& word = all.front().empty() ? all.back() : all.front();
      throw InputError(place_of(*data_),
                       "column " + column->name + " holds text, where " + law.name +
                           " takes numbers",
                       "for example '" + word + "'");
    }
    check_cells(*column, law, *data_);
    return column->values.data();
  }
  if (column)
    own_[input] = renumbered(*column, levels->second, *data_);
  else if (follows_[input])
    own_[input].assign(data_->rows(), 0.0);
  else
    own_[input] = data::derive(*data::find_derived(name), *data_, {});
  return own_[input].data();
}

bool InputColumns::need_tau() const {
  return std::ranges::find(follows_, true) != follows_.end();
}

void InputColumns::derive_from_tau(std::span<const double> tau) {
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (!follows_[i]) continue;
    own_[i] = data::derive(*data::find_derived(names_[i]), *data_, tau);
    pointers_[i] = own_[i].data();
  }
}

std::span<const double> InputColumns::operator[](std::size_t input) const {
  return {pointers_[input], data_->rows()};
}

std::vector<std::vector<double>> InputColumns::values() const {
  std::vector<std::vector<double>> copies;
  for (const double* column : pointers_)
    copies.emplace_back(column, column + data_->rows());
  return copies;
}

std::map<std::string, std::pair<double, double>> InputColumns::ranges() const {
  std::map<std::string, std::pair<double, double>> out;
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (const auto span = range(i); !std::isnan(span.first)) out.emplace(names_[i], span);
  return out;
}

std::pair<double, double> InputColumns::range(std::size_t input) const {
  const data::Column* column = recorded_column(names_[input], *data_);
  return data::source_range(*data_, column ? column->name : names_[input], (*this)[input]);
}

namespace {

double largest(std::span<const double> values) {
  double most = 0;
  for (const double value : values)
    most = std::max(most, std::abs(value));
  return most;
}

// Replaces `tau` by `next` or, if `may_halve` and the step opposes the previous one (oscillation),
// by the mean of both. Updates `step`; returns the relative change.
double replace_tau(std::vector<double>& tau, const std::vector<double>& next,
                   std::vector<double>& step, bool may_halve) {
  double along = 0;
  for (std::size_t i = 0; i < tau.size(); ++i) {
    along += step[i] * (next[i] - tau[i]);
    step[i] = next[i] - tau[i];
  }
  const bool half = may_halve && along < 0;
  for (std::size_t i = 0; i < tau.size(); ++i)
    tau[i] = half ? 0.5 * (tau[i] + next[i]) : next[i];
  return largest(step) / std::max(largest(next), 1e-300);
}

[[noreturn]] void does_not_settle(const models::Model& model, const Dataset& data, double change) {
  throw InputError(place_of(data),
                   fmt::format("the shear stress of {} does not settle: it depends on a history "
                               "of itself, and still changes by {:.2g} of its value",
                               model.name(), change),
                   "calibrate and trace again without that effect ([trace] ignore)");
}

// Selects the inputs of the law among more columns.
std::vector<const double*> pointers_to(const InputColumns& columns,
                                       const std::vector<std::string>& names) {
  std::vector<const double*> out;
  for (const std::string& name : names) {
    const auto at = std::ranges::find(columns.names(), name);
    out.push_back(columns.pointers()[static_cast<std::size_t>(at - columns.names().begin())]);
  }
  return out;
}

} // namespace

Predicted predict_with_columns(const models::AssembledLaw& law, std::vector<std::string> names,
                               const Dataset& data) {
  const models::Model& model = law.model;
  const expr::Program program(law.tau_R, law.inputs, law.parameters);
  Predicted out{InputColumns(*model.law, std::move(names), data), std::vector<double>(data.rows())};
  const auto evaluate = [&](std::vector<double>& tau) {
    program.evaluate(data.rows(), pointers_to(out.columns, law.inputs), model.parameters,
                     tau.data());
  };
  evaluate(out.tau_MPa);
  if (!out.columns.need_tau()) return out;
  std::vector<double> next(data.rows()), step(data.rows());
  double change = 0;
  for (int round = 0; round < most_rounds; ++round) {
    out.columns.derive_from_tau(out.tau_MPa);
    evaluate(next);
    change = replace_tau(out.tau_MPa, next, step, round >= plain_rounds);
    if (!(change > settled_change)) return out;
  }
  does_not_settle(model, data, change);
}

void check_stress(const std::string& law, const Predicted& predicted, const Dataset& data) {
  const NoNumbers rows(predicted.tau_MPa);
  if (rows.count == 0) return;
  std::vector<std::string> states;
  for (std::size_t i = 0; i < predicted.columns.names().size(); ++i)
    states.push_back(
        fmt::format("{} = {:g}", predicted.columns.names()[i], predicted.columns[i][rows.first]));
  throw InputError(place_of(data), fmt::format("{} gives no stress in {}", law, rows.text(data)),
                   "a logarithm or a power of a negative number, or a division by 0? The states "
                   "of the first: " +
                       join(states, ", "));
}

InputColumns input_columns(const models::AssembledLaw& law, std::vector<std::string> names,
                           const Dataset& data) {
  InputColumns columns(*law.model.law, names, data);
  if (!columns.need_tau()) return columns;
  return predict_with_columns(law, std::move(names), data).columns;
}

} // namespace frictab::calibrate
