// Builds formulas from tables.
#include "models/law_table.h"

#include <cmath>
#include <span>

#include <fmt/format.h>

#include "core/text.h"
#include "data/quantity.h"
#include "models/symbols.h"

namespace frictab::models {

namespace {

using expr::Expr;

// Adds the terms pairwise, because the depth of a plain sum grows with its length.
Expr balanced_sum(std::span<const Expr> terms) {
  if (terms.size() == 1) return terms.front();
  const std::size_t half = terms.size() / 2;
  return balanced_sum(terms.first(half)) + balanced_sum(terms.subspan(half));
}

std::vector<Expr> ramps(const LawTableAxis& axis) {
  const Expr x = Expr::symbol(axis.name);
  std::vector<Expr> ramps;
  for (std::size_t i = 0; i + 1 < axis.nodes.size(); ++i) {
    const double low = axis.nodes[i], high = axis.nodes[i + 1];
    const Expr held = minimum(maximum(x, low), high);
    ramps.push_back(axis.log ? (log(held) - std::log(low)) / (std::log(high) - std::log(low))
                             : (held - low) / (high - low));
  }
  return ramps;
}

// Interpolates `values` (row-major) by the ramps of each axis: one sum per axis, nested.
Expr interpolated(std::span<const std::vector<Expr>> ramps, std::span<const double> values) {
  if (ramps.empty()) return values.front();
  const std::size_t stride = values.size() / (ramps.front().size() + 1);
  std::vector<Expr> terms{interpolated(ramps.subspan(1), values.first(stride))};
  for (std::size_t i = 0; i < ramps.front().size(); ++i) {
    std::vector<double> steps;
    for (std::size_t j = 0; j < stride; ++j)
      steps.push_back(values[(i + 1) * stride + j] - values[i * stride + j]);
    const Expr step = interpolated(ramps.subspan(1), steps);
    if (!step.is_constant(0)) terms.push_back(step * ramps.front()[i]);
  }
  return balanced_sum(terms);
}

Expr piece_of(const LawTable& table) {
  std::vector<std::vector<Expr>> all;
  for (const LawTableAxis& axis : table.axes)
    all.push_back(ramps(axis));
  std::vector<double> values = table.value;
  if (!table.log_value) return interpolated(all, values);
  for (double& value : values)
    value = std::log(value);
  return exp(interpolated(all, values));
}

std::string people_text(const LawTable& table) {
  std::vector<std::string> axes;
  for (const LawTableAxis& axis : table.axes)
    axes.push_back(fmt::format("{} ({}, {} nodes)", axis.name, axis.log ? "log" : "linear",
                               axis.nodes.size()));
  const bool is_mu = table.quantity == PieceQuantity::mu;
  return fmt::format("tau_R = {}; value = {} of {}, linear{} between its nodes over {}, held at "
                     "their ends",
                     table.combine ? expr::to_text(*table.combine)
                     : is_mu       ? "value*sigma_n_MPa"
                                   : "value",
                     quantity_name(table.quantity), table.file,
                     table.log_value ? " in its logarithm" : "", join(axes, ", "));
}

} // namespace

Law law_of_table(const LawTable& table) {
  Law law;
  law.name = table.name;
  law.order = 90;
  law.title = table.title.empty() ? "table of the user" : table.title;
  law.reference = table.reference.empty() ? table.file : table.reference;
  law.formula = people_text(table);
  law.calibrated = Calibrated::fixed;
  law.quantity = table.quantity;
  law.log_value = table.log_value;
  for (const LawTableAxis& axis : table.axes) {
    law.log_axes[axis.name] = axis.log;
    law.kinks[axis.name] = axis.nodes;
    law.clamped_inputs[axis.name] = {axis.nodes.front(), axis.nodes.back()};
    if (!data::find_quantity(axis.name)) law.places.emplace(axis.name, axis.place);
  }
  const Expr piece = piece_of(table);
  const bool is_mu = table.quantity == PieceQuantity::mu;
  const Expr combine = table.combine ? *table.combine
                       : is_mu       ? state::value_times_pressure()
                                     : state::value();
  law.build = [piece, combine](const Conventions&) { return Formula{piece, combine}; };
  return law;
}

} // namespace frictab::models
