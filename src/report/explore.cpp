// Collects laws, tests and tables as data for templates/report/explore.js.
#include "report/explore.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "calibrate/input_columns.h"
#include "calibrate/recommended.h"
#include "codegen/javascript.h"
#include "core/template.h"
#include "core/text.h"
#include "data/quantity.h"
#include "report/law_plots.h"
#include "report/page.h"
#include "report/state_plots.h"
#include "words/data.h"
#include "words/numbers.h"
#include "words/render.h"
#include "words/trace.h"

namespace frictab::report {

namespace {

using Json = nlohmann::ordered_json;

// Rows of a test on the page: enough for the shape of a stroke, few enough for 1,000 tests.
constexpr std::size_t rows_of_a_test = 24, rows_of_all_tests = 24'000;

// A state whose values span at least this factor has a logarithmic scale.
constexpr double log_from = 10;

// The tests of one part of the campaign, with a column for each input of any law.
struct Part {
  const data::Dataset* data;
  bool held_out;
  std::map<std::string, std::vector<double>> columns;
};

// Adds the columns of a law's inputs; those that the data do not have stay out.
void add_inputs(Part& part, const models::AssembledLaw& law) {
  std::vector<std::string> wanted;
  for (const std::string& name : law.inputs)
    if (part.columns.count(name) == 0) wanted.push_back(name);
  if (wanted.empty() || !calibrate::missing_inputs(law.inputs, *part.data).empty()) return;
  const calibrate::InputColumns columns = calibrate::input_columns(law, law.inputs, *part.data);
  for (std::size_t i = 0; i < law.inputs.size(); ++i)
    part.columns.try_emplace(law.inputs[i], columns[i].begin(), columns[i].end());
}

// JSON has no NaN; six digits are more than a page can show.
Json rounded(double value) {
  return std::isfinite(value) ? Json(std::stod(fmt::format("{:.6g}", value))) : Json();
}

std::vector<std::size_t> rows_shown(std::size_t first, std::size_t end, std::size_t most) {
  const std::size_t rows = end - first, shown = std::min(rows, most);
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < shown; ++i)
    at.push_back(first + (shown == 1 ? 0 : i * (rows - 1) / (shown - 1)));
  return at;
}

Json tests_json(const std::vector<Part>& parts) {
  std::size_t tests = 0;
  for (const Part& part : parts)
    tests += part.data->experiments.size();
  const std::size_t most = std::clamp<std::size_t>(
      rows_of_all_tests / std::max<std::size_t>(tests, 1), 2, rows_of_a_test);
  Json out = Json::array();
  for (const Part& part : parts)
    for (std::size_t e = 0; e < part.data->experiments.size(); ++e) {
      const auto rows = rows_shown(part.data->first_row[e], part.data->first_row[e + 1], most);
      const auto picked = [&](std::span<const double> values) {
        Json list = Json::array();
        for (const std::size_t row : rows)
          list.push_back(rounded(values[row]));
        return list;
      };
      Json states = Json::object();
      for (const auto& [name, values] : part.columns)
        states[name] = picked(values);
      out.push_back({{"name", part.data->experiments[e]},
                     {"held_out", part.held_out},
                     {"tau", picked(part.data->values("tau_R_MPa"))},
                     {"states", std::move(states)}});
    }
  return out;
}

// Range and median over all tests.
Json state_json(const std::string& name, const std::vector<Part>& parts, const ReportInput& input) {
  std::vector<double> values;
  for (const Part& part : parts)
    if (const auto at = part.columns.find(name); at != part.columns.end())
      std::ranges::copy_if(at->second, std::back_inserter(values),
                           [](double v) { return std::isfinite(v); });
  if (values.empty()) return nullptr;
  std::ranges::sort(values);
  const data::Quantity* quantity = data::find_quantity(name);
  Json j = {{"name", name},
            {"label", axis_name(words::column_name(name, input.traces))},
            {"log", quantity && quantity->log_axis && values.front() > 0 &&
                        values.back() > log_from * values.front()},
            {"low", rounded(values.front())},
            {"high", rounded(values.back())},
            {"middle", rounded(quantile(values, 0.5))}};
  for (const calibrate::ModelFit& fit : input.calibration.fits)
    if (const auto levels = fit.model.law->levels.find(name); levels != fit.model.law->levels.end())
      j["levels"] = levels->second;
  return j;
}

Json law_json(const calibrate::ModelFit& fit, const models::AssembledLaw& law, int decimals) {
  Json j = {{"name", fit.model.law->name},
            {"title", fit.model.law->title},
            {"error", words::fixed(fit.validation.mae_MPa, decimals)},
            {"reference", fit.reference},
            {"inputs", law.inputs}};
  if (fit.band.low && fit.band.high) j["band"] = {*fit.band.low, *fit.band.high};
  return j;
}

Json nodes_json(const std::vector<table::Table>& tables) {
  Json out = Json::object();
  for (const table::Table& table : tables)
    for (const table::TableAxis& axis : table.axes) {
      Json& nodes = out[table.model][axis.name] = Json::array();
      for (const double node : axis.nodes)
        nodes.push_back(rounded(node));
    }
  return out;
}

// "<" could end or begin an element within a script; in JSON it stands in texts only.
std::string in_script(const Json& json) {
  return replace_all(json.dump(), "<", "\\u003c");
}

} // namespace

std::string explore_html(const ReportInput& input) {
  const calibrate::Calibration& c = input.calibration;
  std::vector<Part> parts;
  if (on_other_experiments(c.judged_by)) parts.push_back({&input.training, false, {}});
  parts.push_back({&input.validation, true, {}});
  std::erase_if(parts, [](const Part& part) {
    return part.data->rows() == 0 || !part.data->has("tau_R_MPa");
  });
  Json laws = Json::array();
  std::string functions;
  std::vector<std::string> names;
  const int decimals = words::error_decimals(c);
  for (const calibrate::ModelFit& judged : c.fits) {
    const models::AssembledLaw law(judged.delivered().model);
    for (Part& part : parts)
      add_inputs(part, law);
    for (const std::string& name : law.inputs)
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    functions += fmt::format("laws.push({});\n", codegen::javascript_function(law));
    laws.push_back(law_json(judged, law, decimals));
  }
  Json states = Json::array();
  for (const std::string& name : names)
    if (Json state = state_json(name, parts, input); !state.is_null())
      states.push_back(std::move(state));
  const std::string recommended =
      c.fits.empty() ? "" : calibrate::recommended_fit(c).model.law->name;
  const Json data = {{"laws", std::move(laws)},           {"recommended", recommended},
                     {"states", std::move(states)},       {"tests", tests_json(parts)},
                     {"nodes", nodes_json(input.tables)}, {"process", input.process}};
  TemplateValues values;
  values.text = {{"title", words::escape(words::shown_path(input.title))},
                 {"style", std::string(embedded_template("report/explore.css"))},
                 {"plot_style", std::string(embedded_template("report/uplot/uPlot.min.css"))},
                 {"plot_library", std::string(embedded_template("report/uplot/uPlot.iife.min.js"))},
                 {"plot_license", std::string(embedded_template("report/uplot/LICENSE"))},
                 {"warning", c.synthetic ? words::html_of(synthetic_warning()) : ""},
                 {"data", in_script(data)},
                 {"helpers", codegen::javascript_helpers()},
                 {"functions", functions},
                 {"script", std::string(embedded_template("report/explore.js"))}};
  values.flags["is_synthetic"] = c.synthetic;
  return render_template("report/explore.html", values);
}

} // namespace frictab::report
