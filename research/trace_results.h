// What both benches of tracing ask of columns and results.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gsl/gsl_statistics_double.h>

#include "core/text.h"
#include "trace/trace.h"

namespace frictab::bench {

inline double correlation(std::span<const double> x, std::span<const double> y) {
  return gsl_stats_correlation(x.data(), 1, y.data(), 1, x.size());
}

// Whether two columns of one campaign are as good as one; not where one of them is unknown.
inline bool go_together(std::span<const double> x, std::span<const double> y, double least) {
  return !x.empty() && !y.empty() && std::abs(correlation(x, y)) > least;
}

// What a trace turned down or only led, and why.
inline std::string turned_down(const trace::Trace& trace) {
  std::string why = join(trace.rejected, "; ");
  for (const trace::Lead& lead : trace.leads)
    why += fmt::format("; lead {} p {:.3g}: {}", lead.name, lead.p_value, lead.why);
  return why;
}

// Names of the cases of a group, in order of first appearance.
template <class Results>
std::vector<std::string> case_names(const Results& all, const std::string& group) {
  std::vector<std::string> names;
  for (const auto& result : all)
    if (result.of->group == group &&
        std::find(names.begin(), names.end(), result.of->name) == names.end())
      names.push_back(result.of->name);
  return names;
}

} // namespace frictab::bench
