// Table or the law itself: compares their size, speed and drift. Times are measured on generated C;
// they are printed and never written to a file.
#pragma once

#include <string>
#include <vector>

#include "models/assembled_law.h"
#include "table/table.h"

namespace frictab::verify {

struct FormFigures {
  std::size_t bytes = 0; // bytes of numbers in the source
  // table: the largest found over the range; direct: the largest over the timed states.
  double drift_MPa = 0;
  double ns_per_query = 0; // batch entry, one thread, median of interleaved repeats
};

struct FormComparison {
  std::string model;
  std::size_t nodes = 0; // number of nodes of the table
  FormFigures table, direct;
  std::string why_not; // reason why nothing was timed
};

// Returns the figures that do not depend on the machine: sizes and the table's recorded drift.
FormComparison form_sizes(const models::AssembledLaw& law, const table::Table& table);

// Compiles both forms for target `c` as its recipe does and times them on states that fill the
// ranges of the table.
FormComparison compare_forms(const models::AssembledLaw& law, const table::Table& table);

// Formats as "the law itself is 2.1 times faster: export.form = "direct"". Recommends the law
// unless its table is at least twice as fast.
std::string form_verdict(const FormComparison& comparison);

// Lists the laws that are better exported directly than as tables; empty if there are none.
std::string forms_in_short(const std::vector<FormComparison>& comparisons);
std::string forms_text(const std::vector<FormComparison>& comparisons);

} // namespace frictab::verify
