// Pads cells by their display width.
#include "core/text_table.h"

#include <algorithm>

#include "core/text.h"

namespace frictab {

std::string text_table(const std::vector<std::vector<std::string>>& rows,
                       const std::vector<bool>& right, std::size_t indent) {
  const auto is_right = [&](std::size_t column) { return column < right.size() && right[column]; };
  std::vector<std::size_t> widths;
  for (const std::vector<std::string>& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t c = 0; c < row.size(); ++c)
      if (c + 1 < row.size() || is_right(c)) // a last cell that is aligned left may be long
        widths[c] = std::max(widths[c], characters(row[c]));
  }
  std::string out;
  for (const std::vector<std::string>& row : rows) {
    std::string line(indent, ' ');
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::size_t width = characters(row[c]);
      const std::string gap(widths[c] > width ? widths[c] - width : 0, ' ');
      line += (c == 0 ? "" : "  ") + (is_right(c) ? gap + row[c] : row[c] + gap);
    }
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

} // namespace frictab
