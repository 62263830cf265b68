// [table] of a job.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/hdf5.h"
#include "table/interpolation.h"

namespace frictab::table {

// Parts of a table's range that a proof of its drift looks at (verify.proof_boxes, table/bound.h).
inline constexpr std::size_t usual_proof_boxes = 2'000'000;

struct AxisOptions {
  std::optional<std::pair<double, double>> range;
  std::optional<std::size_t> nodes;
  std::optional<std::string> spacing; // "log" | "linear"
  std::vector<std::string> outside; // clamp | error | law: both sides, or low and high; none: usual
  Place place;
};

struct TableOptions {
  std::vector<std::string> model{"best"}; // best | recommended | names | all
  std::vector<double> quantile{0.5};      // of the experiments: one table each
  std::optional<double> tolerance_MPa;    // none: auto (table/tolerance.h); 0.5 where nobody chose
  std::string tolerance_from;             // in words, where it was chosen
  std::string range = "data"; // what axes reach: data | table1: Table 1 of the paper as well
  std::optional<Interpolation> interpolation; // absent: linear where that is small, else cubic
  std::string coordinates = "law";            // law: those in which it is straight | plain: none
  std::optional<std::size_t> nodes;           // the closest table of so many nodes ...
  std::optional<std::size_t> max_bytes;       // ... or so large, instead of one to a tolerance
  std::map<std::string, AxisOptions> axes;    // by canonical name
  bool distance = true;                       // of every node from the nearest test
  io::Hdf5Storage hdf5;
  Place place;

  // Whether `model` has names alone, not "best", "recommended" or "all".
  bool names_laws() const {
    return std::none_of(model.begin(), model.end(), [](const std::string& name) {
      return name == "best" || name == "recommended" || name == "all";
    });
  }
};

} // namespace frictab::table
