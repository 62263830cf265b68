// Determines the states that a table covers.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "calibrate/determined.h"
#include "calibrate/input_columns.h"
#include "calibrate/stress_error.h"
#include "core/error.h"
#include "data/condense.h"
#include "data/meaning.h"
#include "data/quantity.h"
#include "table/build.h"
#include "table/outside.h"
#include "table/states.h"

namespace frictab::table {

namespace {

using Span = std::pair<double, double>;

StateRange data_range(const std::string& name, const Span& span) {
  return {name, span.first, span.second, "training data", span};
}

void widen_one_value(StateRange& range, double lowest) { // a grid needs two nodes
  if (range.low != range.high) return;
  const double width = 0.01 * std::max(std::abs(range.low), 1e-6);
  range.low = std::max(range.low - width, lowest);
  range.high += width;
  range.why = "training data, one value widened by 1 %";
}

// Share of [a, b] that [low, high] covers, in the coordinate of the axis.
double coverage(const StateRange& range, double a, double b, bool log) {
  const auto u = [&](double x) { return log ? std::log(std::max(x, a * 1e-3)) : x; };
  return (std::min(u(range.high), u(b)) - std::max(u(range.low), u(a))) / (u(b) - u(a));
}

void join_table_1(StateRange& range, const data::Quantity& quantity) {
  if (!quantity.paper_range) return;
  const auto [a, b] = *quantity.paper_range;
  if (coverage(range, a, b, quantity.log_axis) < 0.5) return;
  range.low = std::min(range.low, a);
  range.high = std::max(range.high, b);
  range.why = "Table 1 and training data";
}

StateRange default_range(const data::Quantity& quantity, const Span& span,
                         const TableOptions& options) {
  StateRange range = data_range(quantity.name, span);
  // stress in an FE run exceeds that of the tribometer, to both sides
  if (quantity.name == "sigma_f_MPa") {
    range.low *= 0.5;
    range.high *= 2;
    range.why = "half to twice the training data";
    return range;
  }
  if (options.range == "table1") join_table_1(range, quantity);
  widen_one_value(range, quantity.lowest);
  return range;
}

// Range of an input that an effect added: as far as it was learned, and no further.
StateRange further_range(const models::Law& law, const std::string& name, const Span& span) {
  StateRange range = data_range(name, span);
  if (const auto levels = law.levels.find(name); levels != law.levels.end()) {
    range.low = 0;
    range.high = static_cast<double>(levels->second.size() - 1);
    range.why = "levels of the training data";
    return range;
  }
  widen_one_value(range, data::meaning_of(name).lowest);
  return range;
}

StateRange asked_range(const data::Quantity& quantity, const AxisOptions& axis, const Span& span) {
  const auto [low, high] = *axis.range;
  if (low < quantity.lowest)
    throw InputError(
        axis.place,
        fmt::format("the range of {} starts at {}, below {}", quantity.name, low, quantity.lowest),
        "a " + quantity.meaning + " cannot be smaller");
  return {quantity.name, low, high, "job file", data_range(quantity.name, span).data};
}

// Rejects `outside` for a state that is not an axis: beyond its range the formula takes it as it
// is.
void check_outside(const models::AssembledLaw& law, const std::string& name,
                   const AxisOptions& axis) {
  const auto other =
      std::ranges::find_if(axis.outside, [](const std::string& side) { return side != "law"; });
  if (other == axis.outside.end() || law.piece_inputs.count(name)) return;
  throw InputError(
      axis.place,
      fmt::format("outside = \"{}\" cannot act: {} is not an axis of the table of {}, whose "
                  "formula takes it as it is, beyond its range too",
                  *other, name, law.model.name()),
      fmt::format("leave outside away from [table.axes.{}]; verify and predict say "
                  "which rows lie beyond the range",
                  name));
}

// How far below the tests a contact pressure still matters in a forming process: at a tenth of it,
// friction is about a tenth as well.
constexpr double far_below = 0.1;

std::string percent(double share) {
  return fmt::format("{:.2g} %", 100 * share);
}

// Decides whether a table may continue by the law below the low end of an axis, where it usually
// does: the law's own standard error has to be small there. Skipped if the law clamps the state
// itself, or if the job gives the answer. A tabulated shear stress is skipped as well: clamped, it
// would not vanish with the pressure, which is worse than the error of any law.
void judge_end(StateRange& range, std::size_t input, const models::AssembledLaw& law,
               const calibrate::InputColumns& columns) {
  if (usual_below(range.name) != Outside::law || law.model.law->clamped_inputs.count(range.name) ||
      law.model.law->quantity != models::PieceQuantity::mu || !law.piece_inputs.count(range.name))
    return;
  const calibrate::StressError error(law.model, columns.names());
  std::vector<double> state = calibrate::middle_of(columns);
  const auto at = [&](double value) {
    state[input] = value;
    return error.at(state);
  };
  const auto there = at(far_below * range.low), here = at(range.low);
  if (there && *there < calibrate::allowed_error) return;
  range.below = Outside::clamp;
  range.why_held =
      there && here
          ? fmt::format("held below {:.4g}: at {:.3g} the law's own standard error is {} of the "
                        "stress, {} are allowed ({} at the end itself)",
                        range.low, far_below * range.low, percent(*there),
                        percent(calibrate::allowed_error), percent(*here))
          : fmt::format("held below {:.4g}: the law's own standard error there is not known",
                        range.low);
  range.why_held += fmt::format("; the law there: [table.axes.{}] outside = \"law\"", range.name);
}

} // namespace

std::vector<StateRange> state_ranges(const models::AssembledLaw& law, const data::Dataset& training,
                                     const TableOptions& options) {
  std::vector<StateRange> ranges;
  const calibrate::InputColumns columns = calibrate::input_columns(law, law.inputs, training);
  for (std::size_t i = 0; i < columns.names().size(); ++i) {
    const std::string& name = columns.names()[i];
    const data::Quantity* quantity = data::find_quantity(name);
    const AxisOptions axis = options.axis(name);
    check_outside(law, name, axis);
    if (quantity && axis.range)
      ranges.push_back(asked_range(*quantity, axis, columns.range(i)));
    else if (quantity && quantity->state)
      ranges.push_back(default_range(*quantity, columns.range(i), options));
    else
      ranges.push_back(further_range(*law.model.law, name, columns.range(i)));
    if (axis.outside.empty()) judge_end(ranges.back(), i, law, columns);
  }
  return ranges;
}

std::vector<StateRange> table_ranges(const Table& table, const data::Dataset* data,
                                     const std::string& file) {
  std::vector<StateRange> ranges;
  for (const std::string& name : table.inputs()) {
    const InputRecord& input = table.record.input(name);
    if (const TableAxis* axis = find_axis(table, name))
      ranges.push_back({name, axis->nodes.front(), axis->nodes.back(), "axis"});
    else if (input.low && input.high && *input.low <= *input.high)
      ranges.push_back({name, *input.low, *input.high, "attribute"});
    else if (data && data->has(name))
      ranges.push_back(data_range(name, data::source_range(*data, name, data->values(name))));
    else
      throw InputError({file, 0, 0},
                       "the range of " + name +
                           " is not known: it is not an axis, and the table has no "
                           "attributes range_low_" +
                           name + " and range_high_" + name,
                       "add the two attributes, or give --data with that column");
  }
  return ranges;
}

} // namespace frictab::table
