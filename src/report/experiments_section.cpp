// Shows the error of each test for the best laws: which test is the outlier?
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/text.h"
#include "report/sections.h"
#include "report/svg.h"
#include "words/judged.h"
#include "words/numbers.h"
#include "words/published.h"

namespace frictab::report {

namespace {

using calibrate::ExperimentError;

constexpr std::size_t shown_laws = 3, named_tests = 3;
constexpr double figure_width = 760, figure_height = 130;
const std::string held_out_colour = "#c2410c", trained_colour = "#3f78ab";

// Selects the best laws; constants of the literature would squeeze all others.
std::vector<std::size_t> laws_to_show(const ReportInput& input) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < input.by_experiment.size() && shown.size() < shown_laws; ++i)
    if (i == 0 ||
        words::kind_of(*input.calibration.fits[i].model.law) != words::LawKind::literature)
      shown.push_back(i);
  return shown;
}

// Indices of the tests with the largest errors, the worst first.
std::vector<std::size_t> worst_of(const std::vector<ExperimentError>& tests) {
  std::vector<std::size_t> order;
  for (std::size_t e = 0; e < tests.size(); ++e)
    if (std::isfinite(tests[e].mae_MPa)) order.push_back(e);
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return tests[a].mae_MPa > tests[b].mae_MPa; });
  order.resize(std::min(order.size(), named_tests));
  return order;
}

std::string described(const ExperimentError& test, int decimals) {
  return fmt::format("{}: {} MPa, bias {}, {}", test.experiment,
                     words::fixed(test.mae_MPa, decimals), words::fixed(test.bias_MPa, decimals),
                     test.held_out ? "held out" : "trained on");
}

void add_dots(svg::Plot& plot, const std::vector<ExperimentError>& tests, bool held_out,
              int decimals) {
  std::vector<double> x, y;
  std::vector<std::string> text;
  for (std::size_t e = 0; e < tests.size(); ++e) {
    if (tests[e].held_out != held_out) continue;
    x.push_back(static_cast<double>(e));
    y.push_back(tests[e].mae_MPa);
    text.push_back(described(tests[e], decimals));
  }
  plot.dots(x, y, text, tests.size() > 40 ? 2.5 : 4, held_out ? held_out_colour : trained_colour,
            !held_out);
}

svg::Axis axis_of_errors(const ReportInput& input, const std::vector<std::size_t>& shown) {
  double most = 0;
  for (const std::size_t law : shown)
    for (const ExperimentError& test : input.by_experiment[law].experiments)
      if (std::isfinite(test.mae_MPa)) most = std::max(most, test.mae_MPa);
  return svg::nice_axis(0, 1.1 * most, 4, "MAE / MPa"); // room for names
}

// Names that would cover each other are left out.
void add_names(svg::Plot& plot, const std::vector<ExperimentError>& tests,
               const std::vector<std::size_t>& worst) {
  const double apart = 0.15 * static_cast<double>(tests.size());
  for (std::size_t i = 0; i < worst.size(); ++i) {
    const auto x = static_cast<double>(worst[i]);
    const bool free =
        std::none_of(worst.begin(), worst.begin() + static_cast<long>(i), [&](std::size_t other) {
          return std::abs(x - static_cast<double>(other)) < apart;
        });
    if (free) plot.label(x, tests[worst[i]].mae_MPa, tests[worst[i]].experiment, "#111");
  }
}

words::Section figure_of(const ReportInput& input, std::size_t law, const svg::Axis& errors) {
  const std::vector<ExperimentError>& tests = input.by_experiment[law].experiments;
  const int decimals = words::error_decimals(input.calibration);
  const double mae = input.calibration.fits[law].validation.mae_MPa;
  std::vector<std::string> names;
  for (const ExperimentError& test : tests)
    names.push_back(test.experiment);
  const svg::Axis by_name = svg::named_axis(std::move(names), "");
  svg::Plot plot(figure_width, figure_height, by_name, errors);
  const std::vector<double> ends{by_name.low, by_name.high}, line{mae, mae};
  plot.line(ends, line, {"#111", 1, "4 3", false});
  for (const bool held_out : {false, true})
    add_dots(plot, tests, held_out, decimals);
  const std::vector<std::size_t> worst = worst_of(tests);
  add_names(plot, tests, worst);
  std::vector<std::string> named;
  for (const std::size_t e : worst)
    named.push_back(described(tests[e], decimals));
  const std::string worst_text = "Worst: " + join(named, "; ");
  const std::string& name = input.by_experiment[law].law;
  words::Section section{"", "", name};
  section.say(worst_text + ".");
  section.add(words::Pictures{
      "scroll wide", {{plot.text(name + ": mean absolute error of each test", worst_text)}}});
  return section;
}

} // namespace

words::Section errors_by_test(const ReportInput& input) {
  words::Section section{"experiments", "By test", "Errors by test"};
  const std::vector<std::size_t> shown = laws_to_show(input);
  if (shown.empty()) return section;
  const std::string alike = words::judged_words(input.calibration.judged_by).dots;
  section.say("Mean absolute error of single tests, in the order of the data; the dashed line is "
              "the law's error on the tests that it was not fitted to. " +
              words::Text(alike.empty() ? "Disc: held out; ring: trained on." : alike) +
              " The worst are named; " + words::code("errors_by_experiment.csv") +
              " has every test and law.");
  const svg::Axis errors = axis_of_errors(input, shown);
  for (const std::size_t law : shown)
    section.add(figure_of(input, law, errors));
  return section;
}

} // namespace frictab::report
