// Lists the canonical units that differ in an analysis in metres.
#include "codegen/solver_units.h"

#include <fmt/format.h>

#include "core/error.h"

namespace frictab::codegen {

SolverUnit solver_unit(std::string_view canonical_unit, std::string_view units) {
  if (units != "mm-t-s" && units != "m-kg-s")
    throw InputError({}, fmt::format("unknown unit system '{}' in export.units", units),
                     "known: mm-t-s (MPa, mm/s, mm, N), m-kg-s (Pa, m/s, m, N)");
  if (units == "m-kg-s") {
    if (canonical_unit == "MPa") return {"Pa", 1, 1e6};
    if (canonical_unit == "mm/s") return {"m/s", 1e3, 1};
    if (canonical_unit == "mm") return {"m", 1e3, 1};
    if (canonical_unit == "mm^2") return {"m^2", 1e6, 1};
    // Work and power per area; names may write the product either way.
    if (canonical_unit == "MPa mm") return {"Pa m", 1, 1e3};
    if (canonical_unit == "MPa*mm") return {"Pa*m", 1, 1e3};
    if (canonical_unit == "MPa mm/s") return {"Pa m/s", 1, 1e3};
    if (canonical_unit == "MPa*mm/s") return {"Pa*m/s", 1, 1e3};
  }
  return {std::string(canonical_unit), 1, 1};
}

} // namespace frictab::codegen
