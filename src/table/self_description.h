// What a table file says of itself to readers that know nothing of friction: the attributes of
// CF-1.8 and ACDD-1.3, and coordinates in which a table may be interpolated as it is.
#pragma once

#include <map>
#include <string>

#include "table/table.h"

namespace frictab::table {

// Root attributes: Conventions, title, source, comment.
std::map<std::string, std::string> root_description(const Table& table);

// The comment of `value`: in what it is interpolated, and what goes wrong elsewhere.
std::string value_comment(const Table& table);

// Of an axis with transform = log: the coordinate beside it that holds its logarithm. Empty for
// others, and where the axis' name would not be one word in a list of coordinates.
std::string logarithm_name(const TableAxis& axis);

} // namespace frictab::table
