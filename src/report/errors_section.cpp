// Writes all errors with their intervals, the noise floor next to them, and conditional use.
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "calibrate/noise_floor.h"
#include "report/numbers.h"
#include "report/sections.h"
#include "report/svg.h"

namespace frictab::report {

namespace {

std::string marked_up(double value, const calibrate::Interval& interval, int decimals) {
  return fmt::format("{} <span class=\"interval\">{}</span>", fixed(value, decimals),
                     interval_text(interval, decimals));
}

void put_errors(TemplateValues& row, const std::string& part, const calibrate::Metrics& m,
                int decimals) {
  row.text[part + "_mae"] = marked_up(m.mae_MPa, m.mae_interval, decimals);
  row.text[part + "_rmse"] = marked_up(m.rmse_MPa, m.rmse_interval, decimals);
  row.text[part + "_bias"] = marked_up(m.bias_MPa, m.bias_interval, decimals);
}

} // namespace

void add_errors(TemplateValues& page, const ReportInput& input) {
  const int decimals = error_decimals(input.calibration);
  std::vector<TemplateValues>& rows = page.lists["errors"];
  for (const calibrate::ModelFit& fit : input.calibration.fits) {
    TemplateValues row;
    row.text["law"] = svg::escape(fit.model.law->name);
    put_errors(row, "validation", fit.validation, decimals);
    put_errors(row, "training", fit.training, decimals);
    row.text["band_low"] = factor_text(fit.band.low);
    row.text["band_high"] = factor_text(fit.band.high);
    row.text["band_inside"] = inside_text(fit.band);
    rows.push_back(std::move(row));
  }
  std::vector<TemplateValues>& floors = page.lists["floors"];
  for (const calibrate::NoiseFloor& floor : input.calibration.noise_floors)
    floors.push_back(
        {{{"name", calibrate::noise_floor_name(floor)},
          {"part", floor.part},
          {"mae", marked_up(floor.mae_MPa, floor.mae_interval, decimals)},
          {"rmse", marked_up(floor.rmse_MPa, floor.rmse_interval, decimals)},
          {"size",
           count_of(floor.n_rows, "row") + " of " + count_of(floor.n_experiments, "experiment")},
          {"bound", floor.measured_MPa > 0 ? "lowered to what the best law errs"
                    : floor.lower_bound    ? "lower bound: scatter between experiments not included"
                                           : "no law of the state can do better on average"}},
         {},
         {}});
  page.flags["has_floors"] = !floors.empty();
  page.text["floor_sentence"] = calibrate::noise_floor_sentence(input.calibration, decimals);
  page.text["band_sentence"] = band_sentence;
  const std::string advice = calibrate::noise_floor_advice(input.calibration);
  page.text["floor_advice"] = advice.empty() ? "" : "; " + advice;
}

void add_conditional(TemplateValues& page, const ReportInput& input) {
  const calibrate::Conditional& c = input.calibration.conditional;
  const int decimals = error_decimals(input.calibration);
  page.flags["has_conditional"] = !c.laws.empty();
  page.text["conditional_link"] =
      c.laws.empty() ? "" : "<a href=\"#conditional\">Conditional use</a> ";
  page.text["condition_on"] = short_figures(c.condition_on_mm);
  page.text["condition_counts"] = conditional_counts(c);
  std::vector<TemplateValues>& rows = page.lists["conditional"];
  for (const calibrate::ConditionalFit& fit : c.laws)
    rows.push_back(
        {{{"law", svg::escape(fit.law)},
          {"plain", fixed(fit.unconditional.mae_MPa, decimals)},
          {"mae", marked_up(fit.conditional.mae_MPa, fit.conditional.mae_interval, decimals)},
          {"rmse", marked_up(fit.conditional.rmse_MPa, fit.conditional.rmse_interval, decimals)},
          {"bias", fixed(fit.conditional.bias_MPa, decimals)},
          {"gain", marked_up(fit.gain.value_MPa, fit.gain.interval, decimals)},
          {"trust", fixed(100 * fit.trust, 0)}},
         {},
         {}});
}

} // namespace frictab::report
