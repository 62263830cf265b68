// The section [table] of a job.
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

// Default limit on the boxes that a proof of a table's drift evaluates (verify.proof_boxes,
// table/bound.h).
inline constexpr std::size_t usual_proof_boxes = 2'000'000;

struct AxisOptions {
  std::optional<std::pair<double, double>> range;
  std::optional<std::size_t> nodes;
  std::optional<std::string> spacing; // "log" | "linear"
  // clamp | error | law: both sides, or low and high; empty: the default
  std::vector<std::string> outside;
  Place place;
};

struct TableOptions {
  std::vector<std::string> model{"best"}; // best | recommended | names | all
  std::vector<double> quantile{0.5};      // quantiles of the experiments: one table each
  std::optional<double> tolerance_MPa;    // none: auto (table/tolerance.h); 0.5 if nobody chose
  std::string tolerance_from;             // in words, if it was chosen automatically
  std::string range = "data"; // of the axes: data | table1: joined with Table 1 of the paper
  // absent: linear if the table is small with it, else cubic
  std::optional<Interpolation> interpolation;
  std::string coordinates = "law"; // law: those in which it is straight | plain: no logarithms
  // instead of a tolerance: the closest table of so many nodes ...
  std::optional<std::size_t> nodes;
  std::optional<std::size_t> max_bytes;    // ... or so many bytes
  std::map<std::string, AxisOptions> axes; // by canonical name
  bool distance = true;                    // store the distance of every node from the tests
  io::Hdf5Storage hdf5;
  Place place;

  // Options of one axis; the defaults where the job gives none.
  AxisOptions axis(const std::string& name) const {
    const auto found = axes.find(name);
    return found == axes.end() ? AxisOptions{} : found->second;
  }
  // Whether `model` consists of names, without "best", "recommended" or "all".
  bool names_laws() const {
    return std::ranges::none_of(model, [](const std::string& name) {
      return name == "best" || name == "recommended" || name == "all";
    });
  }
};

} // namespace frictab::table
