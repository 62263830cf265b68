// Sorts the rows of a tabulated law into its grid.
#include "job/law_grid.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/text.h"
#include "data/raw.h"

namespace frictab::job {

namespace {

using models::LawTable;
using models::LawTableAxis;

class LawGrid {
public:
  LawGrid(LawColumns columns, const io::CsvTable& raw, FaultList& faults)
      : raw_(raw), faults_(faults), columns_(std::move(columns)), table_(columns_.table) {}

  std::optional<LawTable> read() {
    const std::size_t before = faults_.size();
    find_nodes();
    if (faults_.size() == before) fill();
    if (faults_.size() > before) return std::nullopt;
    return std::move(table_);
  }

private:
  Place header() const { return {raw_.file, raw_.header_line, 0}; }

  void find_nodes() {
    double count = 1;
    for (std::size_t a = 0; a < table_.axes.size(); ++a) {
      std::vector<double>& nodes = table_.axes[a].nodes;
      nodes = columns_.positions[a];
      std::ranges::sort(nodes);
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      check_distances(table_.axes[a]);
      count *= static_cast<double>(nodes.size());
    }
    const double rows = static_cast<double>(raw_.rows());
    if (count > rows && count > models::most_law_nodes)
      faults_.add(
          header(),
          fmt::format("is not a full grid: {} rows for {} nodes", thousands(raw_.rows()), sizes()),
          "a row for every combination of the axes' values; fit scattered points with a law, or "
          "resample them");
    else if (count > models::most_law_nodes)
      faults_.add(header(), fmt::format("has {} nodes", sizes()),
                  fmt::format("a law that is a table has at most {}: take fewer nodes",
                              thousands(models::most_law_nodes)));
  }

  void check_distances(const LawTableAxis& axis) {
    const std::vector<double>& nodes = axis.nodes;
    if (nodes.size() < 2)
      faults_.add(header(),
                  fmt::format("{} has one value alone, {}", axis.name, shortest(nodes.front())),
                  "an axis has at least two; leave the column out");
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
      if (nodes[i + 1] - nodes[i] < 1e-9 * std::max(std::abs(nodes[i]), std::abs(nodes[i + 1])))
        faults_.add(header(),
                    fmt::format("{} has the nodes {} and {}, which are as good as one", axis.name,
                                shortest(nodes[i]), shortest(nodes[i + 1])),
                    "write the same number in all rows of a node");
  }

  // Returns "12 x 5 = 60".
  std::string sizes() const {
    std::vector<std::string> counts;
    double product = 1;
    for (const LawTableAxis& axis : table_.axes) {
      counts.push_back(std::to_string(axis.nodes.size()));
      product *= static_cast<double>(axis.nodes.size());
    }
    return fmt::format("{} = {:.6g}", join(counts, " x "), product);
  }

  void fill() {
    std::size_t count = 1;
    for (const LawTableAxis& axis : table_.axes)
      count *= axis.nodes.size();
    table_.value.assign(count, 0);
    std::vector<std::size_t> row_of(count, raw_.rows());
    for (std::size_t row = 0; row < raw_.rows(); ++row) {
      const std::size_t node = node_of(row);
      if (row_of[node] < raw_.rows())
        faults_.add(data::row_place(raw_, row),
                    fmt::format("the node {} stands already in {}", state_text(node),
                                raw_.header_line > 0
                                    ? fmt::format("line {}", raw_.line[row_of[node]])
                                    : fmt::format("row {}", raw_.line[row_of[node]])),
                    "one row for every node");
      row_of[node] = row;
      table_.value[node] = columns_.value[row];
    }
    report_missing(row_of);
  }

  std::size_t node_of(std::size_t row) const {
    std::size_t node = 0;
    for (std::size_t a = 0; a < table_.axes.size(); ++a) {
      const std::vector<double>& nodes = table_.axes[a].nodes;
      const auto at = std::ranges::lower_bound(nodes, columns_.positions[a][row]);
      node = node * nodes.size() + static_cast<std::size_t>(at - nodes.begin());
    }
    return node;
  }

  void report_missing(const std::vector<std::size_t>& row_of) {
    const auto is_missing = [&](std::size_t row) { return row == raw_.rows(); };
    const auto missing = std::ranges::count_if(row_of, is_missing);
    if (missing == 0) return;
    const auto first = std::ranges::find_if(row_of, is_missing) - row_of.begin();
    faults_.add(
        header(),
        fmt::format("has no row for the node {}{}", state_text(static_cast<std::size_t>(first)),
                    missing > 1 ? fmt::format(" (and {} more of {})", missing - 1, row_of.size())
                                : ""),
        "a row for every combination of the axes' values");
  }

  std::string state_text(std::size_t node) const {
    std::string text;
    for (std::size_t a = table_.axes.size(); a-- > 0;) {
      const std::vector<double>& nodes = table_.axes[a].nodes;
      text = fmt::format("{} = {}{}{}", table_.axes[a].name, shortest(nodes[node % nodes.size()]),
                         text.empty() ? "" : ", ", text);
      node /= nodes.size();
    }
    return text;
  }

  const io::CsvTable& raw_;
  FaultList& faults_;
  LawColumns columns_;
  LawTable table_;
};

} // namespace

std::optional<LawTable> full_grid(LawColumns columns, const io::CsvTable& raw, FaultList& faults) {
  return LawGrid(std::move(columns), raw, faults).read();
}

} // namespace frictab::job
