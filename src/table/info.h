// A table file described, for a person and for programs.
#pragma once

#include <string>

#include "table/table_file.h"

namespace frictab::table {

std::string info_text(const TableDescription& description, const std::string& file);
std::string info_json(const TableDescription& description, const std::string& file);

} // namespace frictab::table
