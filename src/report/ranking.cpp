// Writes the ranking table and the plots of each law.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "calibrate/noise_floor.h"
#include "calibrate/recommended.h"
#include "calibrate/refit.h"
#include "core/no_value.h"
#include "core/text.h"
#include "report/formula.h"
#include "report/judged.h"
#include "report/law_plots.h"
#include "report/numbers.h"
#include "report/published.h"
#include "report/sections.h"
#include "report/state_plots.h"

namespace frictab::report {

using models::Calibrated;

namespace {

constexpr double bar_width = 220, bar_height = 22;

std::string kind_text(const models::Law& law) {
  switch (law.calibrated) {
  case Calibrated::fixed:
    return "literature, fixed";
  case Calibrated::mean:
    return "means of the training data";
  case Calibrated::fit:
    return "fitted";
  case Calibrated::train:
    return "trained";
  case Calibrated::regress:
    return "fitted, with its formula";
  }
  return "";
}

std::string bar_colour(const models::Law& law) {
  if (law.calibrated == Calibrated::fixed) return "#7f8a96";
  return law.calibrated == Calibrated::mean ? "#6595c4" : "#2f6ea6";
}

// Fixed constants may be many times worse than the rest; laws beyond four times the best do not
// stretch the axis, and their bars are cut.
svg::Axis bar_axis(const calibrate::Calibration& calibration) {
  const double best = calibrate::best_fit(calibration).validation.mae_MPa;
  double high = best;
  for (const calibrate::ModelFit& fit : calibration.fits) {
    const calibrate::Metrics& v = fit.validation;
    const double end = std::isfinite(v.mae_interval.high) ? v.mae_interval.high : v.mae_MPa;
    if (!(v.mae_MPa > 4 * best)) high = std::max(high, end);
  }
  if (!std::isfinite(high) || high <= 0) high = 1;
  return svg::nice_axis(0, high, 5, "MPa");
}

std::string bar_of(const calibrate::ModelFit& fit, double best, const svg::Axis& axis) {
  const calibrate::Metrics& v = fit.validation;
  svg::Bar bar;
  bar.value = v.mae_MPa;
  bar.low = v.mae_interval.low;
  bar.high = v.mae_interval.high;
  bar.reference = best;
  bar.colour = bar_colour(*fit.model.law);
  bar.description =
      fmt::format("{}: {} MPa, 95 % interval {} to {} MPa", fit.model.law->name, figures(v.mae_MPa),
                  figures(v.mae_interval.low), figures(v.mae_interval.high));
  return svg::bar(bar, axis, bar_width, bar_height);
}

std::string parameter_text(const models::Parameter& parameter, double value, double std_error,
                           bool fixed_law) {
  ValueText v = with_error(value, std_error);
  if (fixed_law) v = {short_figures(value), ""};
  std::string text =
      fmt::format("<span class=\"parameter\">{} = {}", svg::escape(parameter.name), v.value);
  if (!v.std_error.empty())
    text += " \u00B1 " + v.std_error;
  else if (!fixed_law)
    text += " (\u00B1 not determined)";
  if (!parameter.unit.empty() && parameter.unit != "1") text += " " + svg::escape(parameter.unit);
  return text + "</span>";
}

std::string parameter_list(const calibrate::ModelFit& fit) {
  const models::Law& law = *fit.model.law;
  if (std::string size = calibrate::size_of_trained(fit); !size.empty()) return size;
  const std::size_t n = std::min(law.parameters.size(), fit.model.parameters.size());
  if (n > 8) return fmt::format("{} parameters, in models/{}.json", n, svg::escape(law.name));
  std::string text;
  for (std::size_t i = 0; i < n; ++i) {
    const double error = i < fit.std_error.size() ? fit.std_error[i] : no_value;
    text += parameter_text(law.parameters[i], fit.model.parameters[i], error,
                           law.calibrated == Calibrated::fixed);
  }
  return text;
}

// Returns the noise floor, on the same scale as the laws above it.
TemplateValues floor_row(const calibrate::Calibration& calibration, const svg::Axis& axis) {
  const calibrate::NoiseFloor& floor = calibration.noise_floors.front();
  const int decimals = error_decimals(calibration);
  const svg::Bar bar{floor.mae_MPa,
                     floor.mae_interval.low,
                     floor.mae_interval.high,
                     calibrate::best_fit(calibration).validation.mae_MPa,
                     "#9c9268",
                     "noise floor: " + figures(floor.mae_MPa) + " MPa"};
  return {
      {{"name", calibrate::noise_floor_name(floor) + (floor.lower_bound ? ": a lower bound" : "") +
                    (floor.part == "training" ? ", training data" : "")},
       {"mae", svg::escape(calibrate::noise_floor_sign(floor)) + fixed(floor.mae_MPa, decimals)},
       {"interval", interval_text(floor.mae_interval, decimals)},
       {"rmse", fixed(floor.rmse_MPa, decimals)},
       {"bar", svg::bar(bar, axis, bar_width, bar_height)}},
      {},
      {}};
}

TemplateValues law_row(const calibrate::ModelFit& fit, std::size_t rank, bool best, int decimals) {
  const calibrate::Metrics& v = fit.validation;
  const std::string reference = std::string("; ") + calibrate::reference_words;
  TemplateValues row;
  row.text = {{"rank", std::to_string(rank)},
              {"row_class", best ? "best" : "other"},
              {"name", svg::escape(fit.model.law->name)},
              {"title", svg::escape(fit.model.law->title)},
              {"formula", formula_html(*fit.model.law)},
              {"kind", kind_text(*fit.model.law) + (fit.reference ? reference : "")},
              {"mae", fixed(v.mae_MPa, decimals)},
              {"interval", interval_text(v.mae_interval, decimals)},
              {"rmse", fixed(v.rmse_MPa, decimals)},
              {"bias", fixed(v.bias_MPa, decimals)},
              {"training_mae", fixed(fit.training.mae_MPa, decimals)},
              {"parameters", parameter_list(fit)}};
  std::vector<TemplateValues>& remarks = row.lists["remarks"];
  for (const std::string& remark : fit.remarks)
    remarks.push_back({{{"text", svg::escape(remark)}}, {}, {}});
  return row;
}

const char* loss_text(calibrate::Loss loss) {
  switch (loss) {
  case calibrate::Loss::l2:
    return "L2 (least squares)";
  case calibrate::Loss::l1:
    return "L1 (least absolute errors)";
  case calibrate::Loss::huber:
    break;
  }
  return "Huber";
}

// Describes how the parameters in the ranking were found.
std::string method_text(const calibrate::Calibration& calibration) {
  std::vector<std::string> methods;
  for (const calibrate::ModelFit& fit : calibration.fits)
    if (fit.model.law->calibrated != Calibrated::fixed && !fit.std_error_method.empty() &&
        std::find(methods.begin(), methods.end(), fit.std_error_method) == methods.end())
      methods.push_back(fit.std_error_method);
  std::string text =
      fmt::format("Loss: {}. Seed {}. Data fingerprint {}.", loss_text(calibration.loss),
                  calibration.seed, svg::escape(calibration.data_hash));
  if (!methods.empty()) text += " Standard errors: " + svg::escape(join(methods, "; ")) + ".";
  return text;
}

// Describes the delivered laws; the ranking is of the validated ones.
std::string delivery_text(const calibrate::Calibration& calibration) {
  std::string text = calibrate::delivery_sentence(calibration, error_decimals(calibration));
  if (text.empty()) return "";
  text.front() = 'D';
  const bool others = calibrate::best_fit(calibration).on_all != nullptr;
  return " " + svg::escape(text) + "." +
         (others ? " Their parameters stand in models/NAME.json and in benchmark.md." : "");
}

void add_plots(TemplateValues& page, const ReportInput& input, std::vector<TemplateValues>& laws) {
  const bool has_plots = input.validation.has("tau_R_MPa") && input.validation.rows() > 0 &&
                         input.predicted.size() == laws.size() && !laws.empty();
  page.flags["has_plots"] = has_plots;
  const PlotFrame frame = has_plots ? plot_frame(input) : PlotFrame{};
  page.text["legend"] = has_plots ? plot_legend(frame) : "";
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const LawPlots plots = has_plots ? law_plots(input, i, frame) : LawPlots{};
    const std::string& name = laws[i].text["name"];
    laws[i].text["link"] = has_plots ? fmt::format("<a href=\"#law-{}\">{}</a>", name, name) : name;
    laws[i].text["plot_predicted"] = plots.predicted;
    laws[i].text["plot_residual"] = plots.residual;
    laws[i].text["note"] = plots.note;
    laws[i].flags["has_note"] = !plots.note.empty();
    laws[i].text["open"] = i == 0 ? " open=\"open\"" : "";
    // Errors of constants of the literature do not depend on a single state.
    const bool literature = kind_of(*input.calibration.fits[i].model.law) == LawKind::literature;
    laws[i].text["state_plots"] =
        has_plots && !literature ? residuals_over_states(input, i, frame) : "";
    laws[i].flags["has_state_plots"] = !laws[i].text["state_plots"].empty();
  }
}

} // namespace

void add_ranking(TemplateValues& page, const ReportInput& input) {
  const calibrate::Calibration& calibration = input.calibration;
  const bool has_laws = !calibration.fits.empty();
  std::vector<TemplateValues>& laws = page.lists["laws"];
  page.lists["floor_rows"] = {};
  page.flags["has_laws"] = has_laws;
  page.text["made_by"] = method_text(calibration) + delivery_text(calibration);
  page.text["validation_size"] = page.text["bar_scale"] = "";
  page.text["plotted_rows"] = judged_words(calibration.judged_by).plotted;
  if (has_laws) {
    const calibrate::Metrics& v = calibrate::best_fit(calibration).validation;
    const svg::Axis axis = bar_axis(calibration);
    page.text["validation_size"] = judged_text(calibration);
    page.text["bar_scale"] = svg::bar_scale(axis, bar_width, bar_height);
    if (!calibration.noise_floors.empty())
      page.lists["floor_rows"].push_back(floor_row(calibration, axis));
    for (std::size_t i = 0; i < calibration.fits.size(); ++i) {
      laws.push_back(law_row(calibration.fits[i], i + 1, i == calibrate::best_place(calibration),
                             error_decimals(calibration)));
      laws.back().text["bar"] = bar_of(calibration.fits[i], v.mae_MPa, axis);
    }
  }
  add_plots(page, input, laws);
  std::vector<TemplateValues>& left_out = page.lists["left_out"];
  for (const calibrate::LeftOut& left : calibration.left_out)
    left_out.push_back({{{"text", svg::escape(left.text())}}, {}, {}});
  page.flags["has_left_out"] = !left_out.empty();
}

void add_published_figures(TemplateValues& page, const ReportInput& input) {
  page.text["published_warning"] = published_warning;
  page.text["published_source"] = published_source;
  std::vector<TemplateValues>& list = page.lists["published"];
  const auto figures = published_figures();
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const std::string ours = counterpart(input.calibration, i);
    list.push_back({{{"what", figures[i].what},
                     {"published", figures[i].mae_MPa},
                     {"ours", ours.empty() ? "\u2013" : svg::escape(ours)}},
                    {},
                    {}});
  }
}

} // namespace frictab::report
