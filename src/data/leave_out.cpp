// data.drop and data.missing.
#include "data/leave_out.h"

#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "data/quantity.h"

namespace frictab::data {

void drop_rows(Part& part, const DataOptions& options) {
  std::vector<char> keep(part.row.size(), 1);
  for (const DropRule& rule : options.drop) {
    const Column* column = part.find(rule.column);
    if (!column && !options.measured && is_measured(rule.column)) continue;
    if (!column) {
      part.faults.add(rule.place,
                      fmt::format("data.drop: the data have no column {}", rule.column));
      continue;
    }
    std::size_t dropped = 0;
    for (std::size_t i = 0; i < keep.size(); ++i) {
      const double x = column->values[i];
      const bool out = (rule.below && x < *rule.below) || (rule.above && x > *rule.above);
      dropped += out && keep[i];
      if (out) keep[i] = 0;
    }
    std::string text = rule.column;
    if (rule.below) text += " below " + shortest(*rule.below);
    if (rule.above)
      text += std::string(rule.below ? " or" : "") + " above " + shortest(*rule.above);
    part.data.dropped.push_back({text, dropped});
  }
  keep_rows(part, keep, "data.drop leaves no row");
}

namespace {

// Rows that this column has no number in, unless they go already.
void drop_without(const Column& column, Part& part, std::vector<char>& keep) {
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    const bool out = !std::isfinite(column.values[i]);
    dropped += out && keep[i];
    if (out) keep[i] = 0;
  }
  if (dropped > 0) part.data.dropped.push_back({"no " + column.name, dropped});
}

} // namespace

void drop_missing(Part& part, const DataOptions& options) {
  if (options.missing != Missing::drop) return;
  std::set<std::size_t> raw_rows;
  for (const MappedFile::CellFault& cell : part.cell_faults)
    if (cell.missing) raw_rows.insert(cell.row);
  std::vector<char> keep;
  for (const std::size_t row : part.row)
    keep.push_back(raw_rows.count(row) == 0);
  if (!raw_rows.empty()) part.data.dropped.push_back({"an empty cell", raw_rows.size()});
  for (const Column& column : part.data.columns)
    if (options.needed && !find_quantity(column.name) && options.needed(column.name))
      drop_without(column, part, keep);
  keep_rows(part, keep, "data.missing = \"drop\" leaves no row");
}

} // namespace frictab::data
