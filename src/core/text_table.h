// A table for the terminal.
#pragma once

#include <string>
#include <vector>

namespace frictab {

// Writes one line per row: `indent` blanks, then the cells, padded to the widest of their column
// and two blanks apart; columns of `right` aligned right. A row may be shorter than others. The
// last cell of a row is not padded on its right, so that it may be long.
std::string text_table(const std::vector<std::vector<std::string>>& rows,
                       const std::vector<bool>& right, std::size_t indent = 2);

} // namespace frictab
