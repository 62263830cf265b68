// Lists the terms of a polynomial law that change ln mu most.
#include <algorithm>

#include <fmt/format.h>

#include "report/numbers.h"
#include "report/polynomial_terms.h"
#include "report/sections.h"
#include "report/svg.h"

namespace frictab::report {

namespace {

TemplateValues term_row(const calibrate::PolynomialTerm& term) {
  const ValueText v = with_error(term.coefficient, term.std_error);
  return {{{"term", svg::escape(term.text)},
           {"b", v.value},
           {"error", v.std_error.empty() ? "\u2013" : v.std_error}},
          {},
          {}};
}

} // namespace

void add_polynomial(TemplateValues& page, const ReportInput& input) {
  std::vector<TemplateValues>& rows = page.lists["polynomial_terms"];
  std::vector<TemplateValues>& coordinates = page.lists["polynomial_coordinates"];
  page.text["polynomial_words"] = polynomial_words;
  page.text["polynomial_count"] = "";
  for (const calibrate::ModelFit& fit : input.calibration.fits) {
    if (!fit.polynomial || fit.polynomial->terms.empty()) continue;
    const auto& terms = fit.polynomial->terms;
    const std::size_t shown = std::min(most_polynomial_terms, terms.size());
    page.text["polynomial_count"] =
        fmt::format("The {} largest of {} terms{}.", shown, terms.size(),
                    shown < terms.size() ? "; all are in calibration.json" : "");
    for (std::size_t t = 0; t < shown; ++t)
      rows.push_back(term_row(terms[t]));
    for (const std::string& coordinate : fit.polynomial->coordinates)
      coordinates.push_back({{{"text", svg::escape(coordinate)}}, {}, {}});
    break; // only one law is called polynomial
  }
  page.flags["has_polynomial"] = !rows.empty();
}

} // namespace frictab::report
