// Table or the law itself: which is smaller, which is faster, at which drift. Times are measured on
// generated C, so they are told and never written to a file.
#pragma once

#include <string>
#include <vector>

#include "models/assembled_law.h"
#include "table/table.h"

namespace frictab::verify {

struct FormFigures {
  std::size_t bytes = 0;   // of numbers in the source
  double drift_MPa = 0;    // table: the largest found over the range; direct: over the states timed
  double ns_per_query = 0; // batch entry, one thread, median of interleaved repeats
};

struct FormComparison {
  std::string model;
  std::size_t nodes = 0; // of the table
  FormFigures table, direct;
  std::string why_not; // not measured
};

// Sizes and the table's known drift alone: what does not depend on the machine.
FormComparison form_sizes(const models::AssembledLaw& law, const table::Table& table);

// Compiles both forms for target `c` as its recipe says and times them on states that fill the
// ranges of the table.
FormComparison compare_forms(const models::AssembledLaw& law, const table::Table& table);

// "the law itself is 2.1 times faster: export.form = "direct"": the law is recommended unless its
// table is at least twice as fast.
std::string form_verdict(const FormComparison& comparison);

// Which laws are better exported themselves than as tables; empty where none is.
std::string forms_in_short(const std::vector<FormComparison>& comparisons);
std::string forms_text(const std::vector<FormComparison>& comparisons);

} // namespace frictab::verify
