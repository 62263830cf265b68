// Writes small multiples of all tests, and their table.
#include "report/data_page.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "core/no_value.h"
#include "data/quantity.h"
#include "report/page.h"
#include "report/state_plots.h"
#include "report/svg.h"
#include "words/data.h"
#include "words/judged.h"
#include "words/numbers.h"

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
  svg::Range range{0, 0};
  for (const Dataset* part : {&page.training, &page.validation})
    for (const Dataset* data : {part, part->aside.get()})
      if (data && data->has(name)) range.hold(data->values(name));
  return svg::nice_axis(range.low, range.high, 2, axis_name(name));
}

svg::Axis row_axis(const DataPage& page) {
  std::size_t most = 1;
  for (const Dataset* data : {&page.training, &page.validation})
    for (std::size_t e = 0; e < data->experiments.size(); ++e)
      most = std::max(most, data->first_row[e + 1] - data->first_row[e]);
  return svg::nice_axis(0, static_cast<double>(most), 2, "row");
}

words::Section strokes_of(const DataPage& page) {
  words::Section section{"strokes", "Strokes", "Strokes"};
  section.say(words::symbol("tau_R") +
              " of every test, all on the same axes; what validates is orange, what is not fitted "
              "(at rest, turning, unloaded) grey. Long tests are drawn by the lowest and highest "
              "value of 150 pieces.");
  const data::Quantity* over = abscissa(page.training);
  const svg::Axis x = over ? axis_over(page, over->name) : row_axis(page);
  const svg::Axis y = axis_over(page, "tau_R_MPa");
  words::Pictures pictures{"strokes"};
  const auto add = [&](const Dataset& data, const char* use, const char* colour) {
    const RowsAside aside(data);
    for (std::size_t e = 0; e < data.experiments.size(); ++e) {
      const Curve curve = curve_of(data, e, over);
      svg::Plot plot(150, 90, x, y);
      const std::string& name = data.experiments[e];
      const Curve not_fitted = aside.curve_of(name, over);
      if (!not_fitted.x.empty()) plot.line(not_fitted.x, not_fitted.y, {"#9aa3ad", 1.2, "", false});
      plot.line(curve.x, curve.y, {colour, 1.2, "", false});
      const std::size_t rows = data.first_row[e + 1] - data.first_row[e];
      pictures.pictures.push_back(
          {plot.text(fmt::format("test {}", name),
                     fmt::format("tau_R of {} of test {}", words::count_of(rows, "row"), name)),
           name + use});
    }
  };
  add(page.training, "", "#1d5491");
  add(page.validation, " (validation)", "#b45309");
  section.add(std::move(pictures));
  return section;
}

} // namespace

std::string data_html(const DataPage& page) {
  const words::DataParts parts{page.training, page.validation, page.judged_by};
  words::Section first{"verdict", "", {}};
  first.say(words::size_text(page.judged_by, page.training, page.validation), "verdict");
  Page out{words::shown_path(page.title),
           "The data before the fit",
           {},
           std::move(first),
           {strokes_of(page), words::tests(parts), words::column_roles(page.training),
            words::data_read(parts, words::Detail::full)}};
  if (page.synthetic) out.warnings.push_back(synthetic_warning());
  for (const std::string& fault : page.faults)
    out.warnings.push_back(words::strong("No rig measures this:") + " " + fault);
  return html_of(out);
}

} // namespace frictab::report
