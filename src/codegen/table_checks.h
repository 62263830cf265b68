// Requirements on a table for code generation: sound, and small enough for compilers.
#pragma once

#include <cstddef>
#include <string>

#include "table/table.h"

namespace frictab::codegen {

// Throws InputError if code cannot be made from the table: values that are not finite, sizes that
// do not fit, more axes than the kernel supports, no formula of the law although the table
// continues by it.
void check_table(const table::Table& table);

// Largest count of numbers (nodes, values, cell polynomials) in a source: gfortran takes 281 MB and
// 4 to 7 s for 210,000 in DATA statements.
inline constexpr std::size_t most_baked_numbers = 300000;

// Hint for a table that is too large.
inline constexpr const char* smaller_table =
    "a larger table.tolerance_MPa, narrower ranges, or a law of fewer states; export.targets = [] "
    "makes the table alone";

// Throws InputError if the source would have more numbers than a compiler takes; `elsewhere` of
// them are outside it. Needs no values: `table` may be a description. `remedy`: a further hint.
void check_table_size(const table::Table& table, std::size_t elsewhere = 0,
                      const std::string& remedy = {});

} // namespace frictab::codegen
