// Counts rows outside a table's range by axis and side.
#include "verify/beyond.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"
#include "table/outside.h"

namespace frictab::verify {

namespace {

void count(BeyondEnd& end, double excess) {
  ++end.rows;
  end.largest_excess = std::max(end.largest_excess, excess);
}

} // namespace

RowsBeyond rows_beyond(const table::Table& table, const table::States& states) {
  const std::vector<table::AxisEnds> axes = table::all_ends(table);
  const std::size_t rows = states.empty() ? 0 : states.front().size();
  RowsBeyond out;
  out.kinds.assign(rows, RowKind::compared);
  std::vector<BeyondEnd> ends;
  for (const table::AxisEnds& axis : axes) {
    const auto name = [&](table::Outside side) {
      return axis.clamped_by_law ? "held" : table::outside_name(side);
    };
    ends.push_back({axis.name, "below", name(axis.below), axis.low, 0, 0});
    ends.push_back({axis.name, "above", name(axis.above), axis.high, 0, 0});
  }
  for (std::size_t i = 0; i < rows; ++i) {
    bool outside = false;
    for (std::size_t a = 0; a < axes.size(); ++a) {
      const double x = states[axes[a].input][i];
      if (!axes[a].leaves(x)) continue;
      outside = true;
      if (x < axes[a].low)
        count(ends[2 * a], axes[a].low - x);
      else
        count(ends[2 * a + 1], x - axes[a].high);
      if (axes[a].clamped_by_law) continue; // the law clamps it as well: compared
      if (axes[a].refuses(x))
        out.kinds[i] = RowKind::refused;
      else if (!axes[a].extends(x) && out.kinds[i] != RowKind::refused)
        out.kinds[i] = RowKind::clamped;
    }
    out.outside += outside;
  }
  std::copy_if(ends.begin(), ends.end(), std::back_inserter(out.ends),
               [](const BeyondEnd& end) { return end.rows > 0; });
  return out;
}

std::string beyond_text(const BeyondEnd& end) {
  return fmt::format("{} {} {:.6g}: {} row{}, up to {:.3g} beyond, {}", end.axis, end.side, end.end,
                     thousands(end.rows), end.rows == 1 ? "" : "s", end.largest_excess,
                     end.outside);
}

std::string target_of(const DriftRecord& record) {
  return record.subject.substr(0, record.subject.find('/'));
}

std::string fixed_states_text(const DriftRecord& record) {
  std::string held;
  for (const auto& [name, value] : *record.fixed_states)
    held += fmt::format("{}{} = {:.6g}", held.empty() ? "" : ", ", name, value);
  const std::string cost =
      record.n_rows == 0 ? "no rows to measure the cost"
                         : fmt::format("mean {:.3g}, largest {:.3g} MPa off the law on the rows",
                                       record.cost_mean_abs_MPa, record.cost_max_abs_MPa);
  return fmt::format("{}: {}", held.empty() ? "no state" : held, cost);
}

std::string cost_text(const DriftRecord& record) {
  return target_of(record) + " holds " + fixed_states_text(record);
}

std::string not_representable_text(const DriftRecord& record) {
  if (record.n_rows_not_representable + record.n_points_not_representable == 0) return "";
  return fmt::format("not asked {} of {} rows and {} points of the range: states its solver is "
                     "never in",
                     thousands(record.n_rows_not_representable), thousands(record.n_rows),
                     thousands(record.n_points_not_representable));
}

} // namespace frictab::verify
