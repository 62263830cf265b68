// Compares two tables at their nodes, at the centres of their cells, and at points that fill the
// common range.
#include "table/difference.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/text.h"
#include "core/text_table.h"
#include "data/quantity.h"
#include "io/json.h"
#include "table/drift.h"

namespace frictab::table {

namespace {

constexpr std::size_t most_states = 200000; // limit for each kind

std::vector<std::string> inputs_of(const Table& a, const Table& b) {
  std::vector<std::string> names = a.inputs();
  for (const std::string& name : b.inputs())
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  return names;
}

bool needs(const Table& table, const std::string& name) {
  const auto inputs = table.inputs();
  return std::ranges::find(inputs, name) != inputs.end();
}

StateRange common_range(const Table& a, const Table& b, const std::string& name) {
  StateRange range{name, -HUGE_VAL, HUGE_VAL, ""};
  for (const Table* table : {&a, &b}) {
    if (!needs(*table, name)) continue;
    const auto own = table->range(name);
    if (!own) continue;
    range.low = std::max(range.low, own->first);
    range.high = std::min(range.high, own->second);
  }
  if (!std::isfinite(range.low))
    throw InputError({}, fmt::format("the range of {} is not known", name),
                     fmt::format("--at {}=NUMBER", name));
  if (range.low > range.high) {
    const auto one = *a.range(name), two = *b.range(name);
    throw InputError({}, fmt::format("the tables have no {} in common: {:g} .. {:g} and {:g} .. "
                                     "{:g}",
                                     name, one.first, one.second, two.first, two.second));
  }
  return range;
}

// Returns one axis per input, with the nodes of both tables within the common range; only its ends
// if the input is fixed or not an axis of either.
std::vector<TableAxis> joint_axes(const Table& a, const Table& b,
                                  const std::vector<StateRange>& ranges) {
  std::vector<TableAxis> axes;
  for (const StateRange& range : ranges) {
    TableAxis joint;
    joint.name = range.name;
    std::set<double> nodes{range.low, range.high};
    for (const Table* table : {&a, &b})
      if (const TableAxis* axis = find_axis(*table, range.name)) {
        joint.log = axis->log;
        for (const double x : axis->nodes)
          if (x > range.low && x < range.high) nodes.insert(x);
      }
    joint.nodes.assign(nodes.begin(), nodes.end());
    axes.push_back(std::move(joint));
  }
  return axes;
}

States nodes_of(const std::vector<TableAxis>& axes) {
  States nodes;
  for (const TableAxis& axis : axes)
    nodes.push_back(axis.nodes);
  return nodes;
}

// Middles of cells, along the axes that have cells.
States middles_of(const std::vector<TableAxis>& axes) {
  States middles = nodes_of(axes);
  for (std::size_t d = 0; d < axes.size(); ++d) {
    const std::vector<double>& x = axes[d].nodes;
    if (x.size() < 2) continue;
    middles[d].clear();
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
      middles[d].push_back(axes[d].log ? std::sqrt(x[i] * x[i + 1]) : 0.5 * (x[i] + x[i + 1]));
  }
  return middles;
}

std::vector<double> answers(const Table& table, const std::vector<StateRange>& ranges,
                            const States& states) {
  const TableFunction function(table);
  std::vector<const double*> columns;
  for (const std::string& name : function.inputs())
    for (std::size_t d = 0; d < ranges.size(); ++d)
      if (ranges[d].name == name) columns.push_back(states[d].data());
  std::vector<double> tau(states.empty() ? 1 : states.front().size());
  function.evaluate(tau.size(), columns, tau);
  return tau;
}

double share_outside(const Table& table, const std::vector<StateRange>& ranges) {
  double inside = 1;
  for (const TableAxis& axis : table.axes)
    for (const StateRange& range : ranges) {
      if (range.name != axis.name || range.why == "held") continue;
      const auto u = [&](double x) { return axis.log ? std::log(x) : x; };
      inside *= (u(range.high) - u(range.low)) / (u(axis.nodes.back()) - u(axis.nodes.front()));
    }
  return 1 - inside;
}

} // namespace

TableDifference difference(const Table& a, const Table& b, const FixedStates& held) {
  TableDifference out;
  for (const std::string& name : inputs_of(a, b)) {
    const auto at = held.find(name);
    out.ranges.push_back(at == held.end() ? common_range(a, b, name)
                                          : StateRange{name, at->second, at->second, "held"});
  }
  const auto axes = joint_axes(a, b, out.ranges);
  States states = grid_points(nodes_of(axes), most_states);
  for (const States& more :
       {grid_points(middles_of(axes), most_states), box_points(out.ranges, most_states)})
    for (std::size_t d = 0; d < states.size(); ++d)
      states[d].insert(states[d].end(), more[d].begin(), more[d].end());
  const std::vector<double> one = answers(a, out.ranges, states),
                            two = answers(b, out.ranges, states);
  out.states = one.size();
  std::vector<double> apart(one.size());
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    apart[i] = std::abs(one[i] - two[i]);
    sum += apart[i];
    squares += apart[i] * apart[i];
  }
  const auto worst = static_cast<std::size_t>(std::ranges::max_element(apart) - apart.begin());
  out.drift.max_abs = apart[worst];
  out.drift.mean_abs = sum / static_cast<double>(apart.size());
  out.drift.rms = std::sqrt(squares / static_cast<double>(apart.size()));
  out.tau_MPa = {one[worst], two[worst]};
  for (const auto& column : states)
    out.worst.push_back(column[worst]);
  const auto p99 = static_cast<long>(std::ceil(0.99 * static_cast<double>(apart.size()))) - 1;
  std::nth_element(apart.begin(), apart.begin() + p99, apart.end());
  out.drift.p99 = apart[static_cast<std::size_t>(p99)];
  out.outside = {share_outside(a, out.ranges), share_outside(b, out.ranges)};
  return out;
}

std::string difference_text(const TableDifference& d, const std::array<std::string, 2>& names) {
  std::string state;
  std::vector<std::vector<std::string>> range;
  for (std::size_t i = 0; i < d.ranges.size(); ++i) {
    const auto& one = d.ranges[i];
    state += fmt::format("{}{}={}", i ? " " : "", one.name, shortest(d.worst[i]));
    range.push_back({one.name, one.why == "held" ? fmt::format("{:g}, held", one.low)
                                                 : fmt::format("{:g} .. {:g}", one.low, one.high)});
  }
  std::string text = fmt::format("Difference of tau_R at {} states of the common range, MPa:\n",
                                 thousands(d.states));
  text += fmt::format("  max   {:.4g} ({:.6g} and {:.6g}){}\n", d.drift.max_abs, d.tau_MPa[0],
                      d.tau_MPa[1], state.empty() ? "" : " at " + state);
  text += fmt::format("  p99   {:.4g}\n  rms   {:.4g}\n  mean  {:.4g}\n", d.drift.p99, d.drift.rms,
                      d.drift.mean_abs);
  if (!range.empty()) text += "Common range:\n" + text_table(range, {});
  for (std::size_t i = 0; i < 2; ++i)
    text += fmt::format("Only in {}: {:.2f} % of its range\n", names[i], 100 * d.outside[i]);
  return text;
}

std::string difference_json(const TableDifference& d, const std::array<std::string, 2>& names) {
  nlohmann::ordered_json j = {{"schema", "frictab/difference/1"},
                              {"tables", names},
                              {"states", d.states},
                              {"max_abs_MPa", d.drift.max_abs},
                              {"p99_MPa", d.drift.p99},
                              {"rms_MPa", d.drift.rms},
                              {"mean_abs_MPa", d.drift.mean_abs},
                              {"tau_R_MPa", d.tau_MPa},
                              {"at", nlohmann::ordered_json::object()},
                              {"range", nlohmann::ordered_json::object()},
                              {"share_outside", d.outside}};
  for (std::size_t i = 0; i < d.ranges.size(); ++i) {
    j["at"][d.ranges[i].name] = d.worst[i];
    j["range"][d.ranges[i].name] = {d.ranges[i].low, d.ranges[i].high};
  }
  return io::json_text(j);
}

} // namespace frictab::table
