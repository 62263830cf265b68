// Finds an input among quantities and histories.
#include "data/meaning.h"

#include "data/derived.h"
#include "data/quantity.h"

namespace frictab::data {

Meaning meaning_of(const std::string& name) {
  if (const Quantity* known = find_quantity(name))
    return {known->unit, known->meaning, known->lowest, known->log_axis, known->state};
  Meaning meaning;
  if (const DerivedQuantity* derived = find_derived(name)) {
    meaning.unit = derived->unit;
    meaning.text = derived->meaning;
  }
  return meaning;
}

} // namespace frictab::data
