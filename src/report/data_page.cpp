// Writes small multiples of all tests, and their table.
#include "report/data_page.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/template.h"
#include "core/text.h"
#include "data/overview.h"
#include "data/quantity.h"
#include "data/roles.h"
#include "report/data_lines.h"
#include "report/judged.h"
#include "report/numbers.h"
#include "report/sections.h"
#include "report/state_plots.h"
#include "report/svg.h"

namespace frictab::report {

namespace {

using data::Dataset;

// Column over which strokes are drawn: the first of these that the data have.
const data::Quantity* abscissa(const Dataset& data) {
  for (const char* name : {"s_mm", "time_s"})
    if (data.has(name)) return data::find_quantity(name);
  return nullptr;
}

struct Curve {
  std::vector<double> x, y;
};

// Returns the curve of one test; a long test is reduced to the lowest and highest value of 150
// pieces, so that spikes are seen.
Curve curve_of(const Dataset& data, std::size_t e, const data::Quantity* over) {
  const std::size_t first = data.first_row[e], rows = data.first_row[e + 1] - first;
  const auto tau = data.values("tau_R_MPa").subspan(first, rows);
  std::vector<double> x(rows);
  std::iota(x.begin(), x.end(), 1);
  if (over) {
    const auto values = data.values(over->name).subspan(first, rows);
    x.assign(values.begin(), values.end());
  }
  Curve curve;
  constexpr std::size_t pieces = 150;
  const std::size_t width = rows / pieces + 1;
  for (std::size_t begin = 0; begin < rows; begin += width) {
    const auto from = tau.begin() + static_cast<long>(begin);
    const auto to = tau.begin() + static_cast<long>(std::min(begin + width, rows));
    const auto [low, high] = std::minmax_element(from, to);
    for (const auto at : {std::min(low, high), std::max(low, high)}) {
      curve.x.push_back(x[static_cast<std::size_t>(at - tau.begin())]);
      curve.y.push_back(*at);
      if (low == high) break;
    }
  }
  return curve;
}

// Rows of a test that are not fitted, found by the test's name; each piece of neighbouring rows is
// a line.
class RowsAside {
public:
  explicit RowsAside(const Dataset& data) : aside_(data.aside.get()) {
    for (std::size_t e = 0; aside_ && e < aside_->experiments.size(); ++e)
      number_[aside_->experiments[e]] = e;
  }

  Curve curve_of(const std::string& test, const data::Quantity* over) const {
    const auto found = number_.find(test);
    if (found == number_.end()) return {};
    const std::size_t first = aside_->first_row[found->second],
                      end = aside_->first_row[found->second + 1];
    const auto tau = aside_->values("tau_R_MPa"), row = aside_->values("row"),
               x = over ? aside_->values(over->name) : row;
    constexpr std::size_t most = 300;
    const std::size_t step = (end - first) / most + 1;
    Curve curve;
    for (std::size_t i = first; i < end; i += step) {
      if (i > first && row[i] > row[i - step] + static_cast<double>(step)) {
        curve.x.push_back(x[i]);
        curve.y.push_back(no_value);
      }
      curve.x.push_back(x[i]);
      curve.y.push_back(tau[i]);
    }
    return curve;
  }

private:
  const Dataset* aside_;
  std::map<std::string, std::size_t> number_;
};

svg::Axis axis_over(const DataPage& page, const std::string& name) {
  double low = 0, high = 0;
  const auto cover = [&](const Dataset* data) {
    for (const double value :
         data && data->has(name) ? data->values(name) : std::span<const double>())
      if (std::isfinite(value)) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
  };
  for (const Dataset* data : {&page.training, &page.validation}) {
    cover(data);
    cover(data->aside.get());
  }
  return svg::nice_axis(low, high, 2, axis_name(name));
}

svg::Axis row_axis(const DataPage& page) {
  std::size_t most = 1;
  for (const Dataset* data : {&page.training, &page.validation})
    for (std::size_t e = 0; e < data->experiments.size(); ++e)
      most = std::max(most, data->first_row[e + 1] - data->first_row[e]);
  return svg::nice_axis(0, static_cast<double>(most), 2, "row");
}

void add_strokes(TemplateValues& values, const DataPage& page) {
  const data::Quantity* over = abscissa(page.training);
  const svg::Axis x = over ? axis_over(page, over->name) : row_axis(page);
  const svg::Axis y = axis_over(page, "tau_R_MPa");
  const auto add = [&](const Dataset& data, const char* use, const char* colour) {
    const RowsAside aside(data);
    for (std::size_t e = 0; e < data.experiments.size(); ++e) {
      const Curve curve = curve_of(data, e, over);
      svg::Plot plot(150, 90, x, y);
      const std::string& name = data.experiments[e];
      const Curve beside = aside.curve_of(name, over);
      if (!beside.x.empty()) plot.line(beside.x, beside.y, {"#9aa3ad", 1.2, "", false});
      plot.line(curve.x, curve.y, {colour, 1.2, "", false});
      const std::size_t rows = data.first_row[e + 1] - data.first_row[e];
      values.lists["strokes"].push_back(
          {{{"name", svg::escape(name)},
            {"use", use},
            {"plot",
             plot.text(fmt::format("test {}", name),
                       fmt::format("tau_R of {} of test {}", count_of(rows, "row"), name))}},
           {},
           {}});
    }
  };
  add(page.training, "", "#1d5491");
  add(page.validation, "validation", "#b45309");
}

std::string span_text(const std::pair<double, double>& span) {
  return span.first == span.second
             ? short_figures(span.first)
             : short_figures(span.first) + " to " + short_figures(span.second);
}

void add_tests(TemplateValues& values, const Dataset& data, const char* use) {
  for (const data::TestOverview& test : data::overview(data)) {
    TemplateValues row{{{"name", svg::escape(test.experiment)},
                        {"use", use},
                        {"rows", thousands(test.rows)},
                        {"mu", figures(test.mean_mu)},
                        {"of_k", test.mean_of_k ? figures(*test.mean_of_k) : "\u2013"}},
                       {},
                       {}};
    for (const auto& [name, span] : test.spans)
      row.text["spans"] += "<td class=\"num\">" + span_text(span) + "</td>";
    values.lists["tests"].push_back(std::move(row));
  }
}

// Lists each column's role for friction.
void add_columns(TemplateValues& values, const Dataset& data) {
  for (const data::Column& column : data.columns)
    values.lists["columns"].push_back({{{"name", svg::escape(column.name)},
                                        {"role", data::role_name(column.role)},
                                        {"why", svg::escape(column.why)}},
                                       {},
                                       {}});
}

} // namespace

std::string data_html(const DataPage& page) {
  TemplateValues values;
  values.text["title"] = svg::escape(shown_path(page.title));
  values.text["style"] = std::string(embedded_template("report/style.css"));
  values.text["size"] = size_text(page.judged_by, page.training, page.validation);
  values.flags["synthetic"] = page.synthetic;
  for (const std::string& fault : page.faults)
    values.lists["faults"].push_back({{{"text", svg::escape(fault)}}, {}, {}});
  values.flags["has_faults"] = !page.faults.empty();
  for (const data::Quantity& quantity : data::quantities())
    if (page.training.has(quantity.name))
      values.text["quantity_names"] +=
          "<th scope=\"col\" class=\"num\">" + svg::escape(quantity.name) + "</th>";
  add_strokes(values, page);
  add_tests(values, page.training, "training");
  add_tests(values, page.validation, "validation");
  add_columns(values, page.training);
  add_data_lines(values, page.training, page.validation, page.judged_by);
  return render_template("report/data.html", values);
}

} // namespace frictab::report
