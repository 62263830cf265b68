// A table file's description for readers that know nothing of friction: the attributes of CF-1.8
// and ACDD-1.3, and coordinates in which a table may be interpolated as it is.
#pragma once

#include <map>
#include <string>

#include "table/table.h"

namespace frictab::table {

// Root attributes: Conventions, title, source, comment.
std::map<std::string, std::string> root_description(const Table& table);

// The comment of `value`: the coordinates in which it is interpolated, and the error in others.
std::string value_comment(const Table& table);

// Name of the additional coordinate that stores the logarithm of an axis with transform = log.
// Empty for other axes, and if the axis' name would not be one word in a list of coordinates.
std::string logarithm_name(const TableAxis& axis);

} // namespace frictab::table
