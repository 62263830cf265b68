// Makes the grid: nodes per axis from the measured error along that axis, then checks the whole.
#include "table/build.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <unistd.h>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/text.h"
#include "data/quantity.h"
#include "table/drift.h"

namespace frictab {

namespace {

constexpr std::size_t max_nodes_per_axis = 4097;

struct Plan {
  TableAxis axis;
  std::vector<double> fixed; // canonical: ends and kinks, ascending
  std::size_t cells = 1;     // between the ends
  bool by_user = false;
};

double to_u(const TableAxis& axis, double x) {
  return axis.log ? std::log(x) : x;
}
double to_x(const TableAxis& axis, double u) {
  return axis.log ? std::exp(u) : u;
}

// `cells` cells spread over the segments between fixed nodes in proportion to their length.
std::vector<double> make_nodes(const Plan& plan, std::size_t cells) {
  std::vector<double> nodes;
  const double length = to_u(plan.axis, plan.fixed.back()) - to_u(plan.axis, plan.fixed.front());
  for (std::size_t s = 0; s + 1 < plan.fixed.size(); ++s) {
    const double a = to_u(plan.axis, plan.fixed[s]);
    const double b = to_u(plan.axis, plan.fixed[s + 1]);
    const auto share = static_cast<std::size_t>(
        std::max(1.0, std::ceil(static_cast<double>(cells) * (b - a) / length - 1e-9)));
    nodes.push_back(plan.fixed[s]);
    for (std::size_t i = 1; i < share; ++i)
      nodes.push_back(
          to_x(plan.axis, a + (b - a) * static_cast<double>(i) / static_cast<double>(share)));
  }
  nodes.push_back(plan.fixed.back());
  return nodes;
}

Plan plan_axis(const Law& law, const StateRange& range, const TableOptions& options) {
  const Quantity& quantity = *find_quantity(range.name);
  const auto asked = options.axes.find(range.name);
  Plan plan;
  plan.axis.name = range.name;
  plan.axis.unit = quantity.unit;
  plan.axis.long_name = quantity.meaning;
  const auto own = law.log_axes.find(range.name);
  plan.axis.log = (own == law.log_axes.end() ? quantity.log_axis : own->second) && range.low > 0;
  if (asked != options.axes.end() && asked->second.spacing) {
    plan.axis.log = *asked->second.spacing == "log";
    if (plan.axis.log && range.low <= 0)
      throw InputError(asked->second.place,
                       fmt::format("the axis {} cannot be logarithmic: its range starts at {}",
                                   range.name, range.low),
                       "spacing = \"linear\", or a range that starts above 0");
  }
  plan.fixed = {range.low, range.high};
  if (const auto kinks = law.kinks.find(range.name); kinks != law.kinks.end())
    for (const double kink : kinks->second)
      if (kink > range.low && kink < range.high) plan.fixed.push_back(kink);
  std::sort(plan.fixed.begin(), plan.fixed.end());
  if (asked != options.axes.end() && asked->second.nodes) {
    plan.cells = *asked->second.nodes - 1;
    plan.by_user = true;
  }
  plan.axis.nodes = make_nodes(plan, plan.cells);
  return plan;
}

// tau_R from the tabulated piece, and the piece itself, as functions of all inputs.
struct Pieces {
  std::vector<std::string> names;
  Program value;
  Program combine; // row: value, then names
  std::vector<double> parameters;
};

Pieces pieces_of(const Model& model, const std::vector<StateRange>& ranges) {
  std::vector<std::string> names, row{"value"};
  for (const StateRange& range : ranges) {
    names.push_back(range.name);
    row.push_back(range.name);
  }
  const Formula formula = model.law->build(model.conventions);
  return {names, Program(formula.value, names, parameter_names(*model.law)),
          Program(limited_combine(model), row, parameter_names(*model.law)), model.parameters};
}

// Largest error in MPa of linear interpolation along axis `d` alone, other states spread over their
// ranges.
double error_along(const Pieces& pieces, const std::vector<StateRange>& ranges, std::size_t d,
                   const TableAxis& axis, bool log_value) {
  constexpr std::size_t others = 96;
  std::vector<double> errors(axis.nodes.size() - 1, 0.0);
  parallel_for(errors.size(), [&](std::size_t cell) {
    std::vector<double> unit(ranges.size()), state(ranges.size()), row(ranges.size() + 1);
    const double low = axis.nodes[cell], high = axis.nodes[cell + 1];
    const double middle = to_x(axis, 0.5 * (to_u(axis, low) + to_u(axis, high)));
    const auto tau = [&](double value) {
      row[0] = value;
      std::copy(state.begin(), state.end(), row.begin() + 1);
      return pieces.combine(row, pieces.parameters);
    };
    const auto value_at = [&](double x) {
      state[d] = x;
      return pieces.value(state, pieces.parameters);
    };
    for (std::size_t i = 0; i < others; ++i) {
      halton(i, unit);
      for (std::size_t k = 0; k < ranges.size(); ++k) {
        // ends and inside alternate: errors of monotone laws are largest at the ends
        const double share = i % 3 == 0 ? std::round(unit[k]) : unit[k];
        state[k] = ranges[k].low + share * (ranges[k].high - ranges[k].low);
      }
      double a = value_at(low), b = value_at(high);
      const double between =
          log_value ? std::exp(0.5 * (std::log(a) + std::log(b))) : 0.5 * (a + b);
      const double exact = value_at(middle);
      errors[cell] = std::max(errors[cell], std::abs(tau(between) - tau(exact)));
    }
  });
  return *std::max_element(errors.begin(), errors.end());
}

// Fewest cells with which the error along the axis stays below `target`.
std::size_t cells_for(const Pieces& pieces, const std::vector<StateRange>& ranges, std::size_t d,
                      Plan plan, bool log_value, double target) {
  const auto error = [&](std::size_t cells) {
    plan.axis.nodes = make_nodes(plan, cells);
    return error_along(pieces, ranges, d, plan.axis, log_value);
  };
  std::size_t high = 1;
  while (high < max_nodes_per_axis - 1 && error(high) > target)
    high *= 2;
  std::size_t low = high / 2; // fails
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (error(middle) > target ? low : high) = middle;
  }
  return high;
}

std::size_t count_nodes(const std::vector<Plan>& plans) {
  std::size_t nodes = 1;
  for (const Plan& plan : plans) {
    if (nodes > SIZE_MAX / 16 / plan.axis.nodes.size()) return SIZE_MAX / 16;
    nodes *= plan.axis.nodes.size();
  }
  return nodes;
}

void check_memory(const std::vector<Plan>& plans, const TableOptions& options) {
  const double bytes = 8.0 * static_cast<double>(count_nodes(plans));
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (bytes < 0.5 * memory) return;
  std::vector<std::string> counts;
  for (const Plan& plan : plans)
    counts.push_back(fmt::format("{} {}", plan.axis.name, plan.axis.nodes.size()));
  throw InputError(
      options.place,
      fmt::format("the table needs {} ({} nodes: {}), more than half of this machine's "
                  "memory",
                  human_bytes(bytes), thousands(count_nodes(plans)), join(counts, ", ")),
      "fewer nodes in [table.axes], a larger tolerance_MPa, or narrower ranges");
}

// Values at all nodes, row-major, last axis fastest. Inputs that are no axis do not matter to the
// piece; they are held at the lower end of their range.
std::vector<double> sample(const Pieces& pieces, const std::vector<StateRange>& ranges,
                           const std::vector<Plan>& plans, const std::vector<std::size_t>& input) {
  std::vector<double> values(count_nodes(plans));
  constexpr std::size_t chunk = 16384;
  parallel_for((values.size() + chunk - 1) / chunk, [&](std::size_t c) {
    std::vector<double> state;
    for (const StateRange& range : ranges)
      state.push_back(range.low);
    for (std::size_t i = c * chunk; i < std::min(values.size(), (c + 1) * chunk); ++i) {
      std::size_t rest = i;
      for (std::size_t a = plans.size(); a-- > 0;) {
        const auto& nodes = plans[a].axis.nodes;
        state[input[a]] = nodes[rest % nodes.size()];
        rest /= nodes.size();
      }
      values[i] = pieces.value(state, pieces.parameters);
    }
  });
  return values;
}

Table assemble(const Model& model, const Pieces& pieces, const std::vector<StateRange>& ranges,
               const std::vector<Plan>& plans, const std::vector<std::size_t>& input,
               bool log_value) {
  Table table;
  table.model = model.name();
  table.quantity = model.law->quantity;
  table.log_value = log_value;
  for (const Plan& plan : plans)
    table.axes.push_back(plan.axis);
  table.value = sample(pieces, ranges, plans, input);
  if (log_value)
    for (double& value : table.value)
      value = std::log(value);
  table.combine = limited_combine(model);
  const auto used = symbols(table.combine);
  for (std::size_t p = 0; p < model.parameters.size(); ++p)
    if (used.count(model.law->parameters[p].name))
      table.constants[model.law->parameters[p].name] = model.parameters[p];
  for (const StateRange& range : ranges) {
    table.number_attributes["range_low_" + range.name] = range.low;
    table.number_attributes["range_high_" + range.name] = range.high;
    table.text_attributes["range_from_" + range.name] = range.why;
  }
  table.text_attributes["model"] = model.name();
  table.number_attributes["quantile"] = model.quantile;
  table.number_attributes["gain"] = model.gain;
  table.text_attributes["formula"] = model.law->formula;
  table.text_attributes["shear_yield"] = model.conventions.shear_yield;
  return table;
}

} // namespace

Table build_table(const Model& model, const std::vector<StateRange>& ranges,
                  const TableOptions& options) {
  const Pieces pieces = pieces_of(model, ranges);
  const auto used = symbols(model.law->build(model.conventions).value);
  std::vector<Plan> plans;
  std::vector<std::size_t> input;
  for (std::size_t r = 0; r < ranges.size(); ++r)
    if (used.count(ranges[r].name)) {
      plans.push_back(plan_axis(*model.law, ranges[r], options));
      input.push_back(r);
    }
  check_memory(plans, options);
  const std::vector<double> ends = sample(pieces, ranges, plans, input);
  const bool log_value = model.law->log_value && *std::min_element(ends.begin(), ends.end()) > 0;
  const LawFunction law(model, pieces.names);
  std::string trail;
  Table table;
  // Errors of the axes add up; each gets an equal share, which needs the fewest nodes for errors
  // that fall with the square of the spacing. Cross terms can ask for another round.
  double share = 0.9;
  for (int round = 0; round < 8; ++round, share *= 0.6) {
    std::size_t active = 0;
    for (std::size_t a = 0; a < plans.size(); ++a)
      active += error_along(pieces, ranges, input[a], plans[a].axis, log_value) >
                1e-3 * options.tolerance_MPa;
    const double target =
        share * options.tolerance_MPa / static_cast<double>(std::max<std::size_t>(active, 1));
    for (std::size_t a = 0; a < plans.size(); ++a) {
      if (!plans[a].by_user)
        plans[a].cells = std::max(plans[a].cells,
                                  cells_for(pieces, ranges, input[a], plans[a], log_value, target));
      plans[a].axis.nodes = make_nodes(plans[a], plans[a].cells);
    }
    check_memory(plans, options);
    table = assemble(model, pieces, ranges, plans, input, log_value);
    const TableFunction function(table);
    const WorstCase worst =
        worst_case(law, function, ranges, probe_points(ranges, table.axes, 20000));
    trail += fmt::format("{}{} nodes: {:.3g} MPa", trail.empty() ? "" : "; ",
                         thousands(table.nodes()), worst.drift_MPa);
    const bool fixed =
        std::all_of(plans.begin(), plans.end(), [](const Plan& p) { return p.by_user; });
    if (worst.drift_MPa <= options.tolerance_MPa || fixed) break;
  }
  table.number_attributes["tolerance_MPa"] = options.tolerance_MPa;
  table.text_attributes["refinement"] = trail;
  return table;
}

} // namespace frictab
