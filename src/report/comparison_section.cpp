// Answers whether law A is better than law B: a triangular table of all pairs, and the laws that
// may be the best.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "calibrate/comparison.h"
#include "report/numbers.h"
#include "report/sections.h"
#include "report/svg.h"

namespace frictab::report {

namespace {

// Three classes that differ by shade and by the cell's own sign.
const char* class_of(const calibrate::Difference& d) {
  if (d.p_value < 0.001) return "clear";
  return d.distinguishable() ? "better" : "open";
}

std::string cell(const calibrate::Comparison& pair, int decimals) {
  const calibrate::Difference& d = pair.mae;
  const std::string what =
      fmt::format("{} against {}: {} MPa, 95 % {}, p {}; RMSE: {} MPa, 95 % {}, p {}", pair.law,
                  pair.other, fixed(d.value_MPa, decimals), interval_text(d.interval, decimals),
                  p_text(d.p_value), fixed(pair.rmse.value_MPa, decimals),
                  interval_text(pair.rmse.interval, decimals), p_text(pair.rmse.p_value));
  return fmt::format("<td class=\"{}\" title=\"{}\">{}</td>", class_of(d), svg::escape(what),
                     fixed(d.value_MPa, std::max(0, decimals - 1)));
}

// Returns the cells of law j (by rank), one for every law ranked before it.
std::string cells_of(const calibrate::Comparisons& c, std::size_t j, int decimals) {
  std::string text;
  for (const calibrate::Comparison& pair : c.pairs)
    if (pair.other == c.laws[j]) text += cell(pair, decimals);
  for (std::size_t i = j; i + 1 < c.laws.size(); ++i)
    text += "<td></td>";
  return text;
}

} // namespace

void add_comparisons(TemplateValues& page, const ReportInput& input) {
  const calibrate::Comparisons& c = input.calibration.comparisons;
  const int decimals = error_decimals(input.calibration);
  page.flags["has_comparisons"] = c.laws.size() > 1;
  page.text["pairwise_sentence"] = svg::escape(calibrate::pairwise_sentence(c));
  page.text["family_sentence"] = svg::escape(calibrate::family_sentence(c));
  page.text["compared_on"] = count_of(c.n_experiments, "validation experiment");
  std::vector<TemplateValues>& columns = page.lists["compared_columns"];
  std::vector<TemplateValues>& rows = page.lists["compared_rows"];
  for (std::size_t i = 0; i < c.laws.size(); ++i) {
    if (i + 1 < c.laws.size()) columns.push_back({{{"rank", std::to_string(i + 1)}}, {}, {}});
    const double p = c.best_p_values[i];
    rows.push_back({{{"rank", std::to_string(i + 1)},
                     {"law", svg::escape(c.laws[i])},
                     {"cells", cells_of(c, i, decimals)},
                     {"best_p", std::isnan(p) ? "reference" : svg::escape(p_text(p))},
                     {"best_class", p >= 0.05 ? "may" : "no"}},
                    {},
                    {}});
  }
}

} // namespace frictab::report
