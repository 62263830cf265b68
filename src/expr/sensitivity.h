// How much a formula can change when one of its symbols does: a slope that holds between any two
// values in a range (a Lipschitz interval), kinks included.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "expr/bounds.h"

namespace frictab {

class Sensitivity {
public:
  // `columns`: every symbol of the formula; `of`: the one that changes.
  Sensitivity(const Expr& formula, const std::vector<std::string>& columns, const std::string& of);

  struct Result {
    Bounds range; // of the formula over the box
    // f(.., v, ..) - f(.., w, ..) lies in slope (v - w) for all v, w in the range of `of` and the
    // other symbols anywhere in theirs. The whole line where nothing is known.
    Bounds slope;
  };
  Result operator()(std::span<const Bounds> box) const;

private:
  struct Step {
    Op op;
    double value = 0;
    std::size_t symbol = 0;
    std::size_t a[4] = {};
    bool changes = false; // with the symbol `of`
  };
  std::vector<Step> steps_;
  std::size_t of_;
};

} // namespace frictab
