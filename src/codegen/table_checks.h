// What a table has to be for code to be made of it: sound, and no larger than compilers bear.
#pragma once

#include <cstddef>
#include <string>

#include "table/table.h"

namespace frictab::codegen {

// Throws InputError where a table cannot be made into code: values that are not finite, sizes that
// do not fit, more axes than the kernel holds, no law's formula where the table goes on by it.
void check_table(const table::Table& table);

// Most numbers (nodes, values, cell polynomials) that a source may hold: gfortran takes 281 MB and
// 4 to 7 s for 210,000 in DATA statements.
inline constexpr std::size_t most_baked_numbers = 300000;

// How a table gets smaller: the hint of what refuses one.
inline constexpr const char* smaller_table =
    "a larger table.tolerance_MPa, narrower ranges, or a law of fewer states; export.targets = [] "
    "makes the table alone";

// Throws InputError where the source would hold more numbers than a compiler takes; `elsewhere` of
// them are not in it. Needs no values: `table` may be a description. `remedy`: a further one.
void check_table_size(const table::Table& table, std::size_t elsewhere = 0,
                      const std::string& remedy = {});

} // namespace frictab::codegen
