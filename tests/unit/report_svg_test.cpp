// Plots: axes, bins, colours, running quantiles, numbers.
#include <cmath>
#include <limits>
#include <numeric>

#include <gmock/gmock.h>
#include <pugixml.hpp>

#include "report/law_plots.h"
#include "report/slice_plot.h"
#include "report/svg.h"
#include "words/numbers.h"

namespace frictab::report_svg_test {

using words::figures;
using words::with_error;
namespace svg = report::svg;

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Svg, AxisHoldsTheDataBetweenRoundTicks) {
  const svg::Axis axis = svg::nice_axis(-35, 112, 9, "x");
  EXPECT_THAT(axis.ticks, ElementsAre(-40, -20, 0, 20, 40, 60, 80, 100, 120));
  EXPECT_EQ(axis.low, -40);
  EXPECT_EQ(axis.high, 120);
  EXPECT_EQ(svg::tick_label(axis, -40), "\u221240");
  EXPECT_EQ(svg::tick_label(axis, -0.0), "0");
}

TEST(Svg, AxisOfSmallNumbersLabelsThemApart) {
  const svg::Axis axis = svg::nice_axis(0, 0.05, 5, "x");
  EXPECT_EQ(svg::tick_label(axis, axis.ticks[1]), "0.01");
}

TEST(Svg, AxisOfOneValueOrNoneIsStillAnAxis) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  const std::pair<double, double> cases[] = {{0, 0}, {42, 42}, {nan, nan}, {-inf, inf}, {5, 1}};
  for (const auto& [low, high] : cases) {
    const svg::Axis axis = svg::nice_axis(low, high, 5, "x");
    EXPECT_LT(axis.low, axis.high);
    EXPECT_GE(axis.ticks.size(), 2u);
    EXPECT_LE(axis.ticks.size(), 12u);
  }
}

TEST(Svg, LabelsOfLongNumbersFitBesideThePlotAndDoNotTouch) {
  constexpr double digit = 6.1; // of a sans-serif of 11 pixels
  const svg::Axis x = svg::nice_axis(0, 400000, 8, "s, mm"), y = svg::nice_axis(0, 1200000, 4, "t");
  pugi::xml_document page;
  ASSERT_TRUE(page.load_string(svg::Plot(150, 84, x, y).text("t", "").c_str()));
  const pugi::xml_node plot = page.child("svg");
  const double width = std::stod(std::string(plot.attribute("viewBox").value()).substr(4));
  double free = 0; // from where on nothing is written below the plot
  std::size_t below = 0, beside = 0;
  for (const pugi::xml_node text : plot.children("text")) {
    if (text.attribute("class")) continue; // of an axis
    const std::string label = text.child_value();
    const double at = text.attribute("x").as_double();
    const double length = digit * static_cast<double>(label.size());
    if (text.attribute("text-anchor").value() == std::string("end")) {
      EXPECT_GT(at - length, 20) << label << " covers the axis' label";
      ++beside;
      continue;
    }
    EXPECT_GT(at - length / 2, free) << label;
    free = at + length / 2;
    EXPECT_LT(free, width) << label << " is cut at the right";
    ++below;
  }
  EXPECT_GE(below, 2u);
  EXPECT_EQ(beside, y.ticks.size());
}

TEST(Svg, BinsCountEachRowOnceFromTheTop) {
  svg::Axis axis;
  axis.high = 2;
  const std::vector<double> x{0, 0.5, 2, 1.5, 3, std::nan("")}, y{0, 0.5, 2, 0.5, 1, 1};
  const svg::Density d = svg::bin(x, y, axis, axis, 2, 2);
  EXPECT_THAT(d.counts, ElementsAre(0, 1, 2, 1));
  EXPECT_EQ(d.outside, 2u);
}

TEST(Svg, ClassesOfCountsGrowByAboutTheSameFactor) {
  EXPECT_THAT(svg::count_classes(1, 7), ElementsAre(1));
  EXPECT_THAT(svg::count_classes(3, 7), ElementsAre(1, 2, 3));
  EXPECT_THAT(svg::count_classes(1000, 3), ElementsAre(1, 10, 100));
  EXPECT_THAT(svg::count_classes(0, 7), ElementsAre(1));
}

TEST(Svg, PlotIsWellFormedAndDescribesItself) {
  svg::Plot plot(100, 50, svg::nice_axis(0, 10, 5, "x & y"), svg::nice_axis(0, 1, 2, "\u03C4_R"));
  const std::vector<double> x{0, 1, std::nan(""), 5, 6}, y{0, 1e300, 0, 0.5, 0.5};
  plot.line(x, y, {"#123456", 1, "4 2", true});
  const std::string text = plot.text("a < b", "what \"it\" shows");
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(text.c_str())) << text;
  EXPECT_STREQ(document.child("svg").attribute("role").value(), "img");
  EXPECT_STREQ(document.child("svg").attribute("aria-label").value(), "a < b");
  EXPECT_STREQ(document.child("svg").child_value("title"), "a < b");
  EXPECT_STREQ(document.child("svg").child_value("desc"), "what \"it\" shows");
  EXPECT_THAT(text, HasSubstr("M50 25L60 25")); // the line starts anew behind the gap
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_THAT(text, HasSubstr("x &amp; y"));
}

TEST(Svg, LabelsOfLinesThatEndTogetherStandApartBesideThePlot) {
  svg::Plot plot(200, 100, svg::nice_axis(0, 1, 2, ""), svg::nice_axis(0, 10, 2, ""));
  plot.labels_beside(
      1, {{5, "a", "#111"}, {5.01, "b", "#111"}, {4.9, "c", "#111"}, {0, "1234567", "#111"}});
  const std::string text = plot.text("t", "");
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(text.c_str())) << text;
  std::vector<double> heights;
  double right = 0;
  for (const char* name : {"b", "a", "c", "1234567"}) { // from the top
    const pugi::xml_node label = document.child("svg").find_child(
        [&](pugi::xml_node n) { return n.text().get() == std::string(name); });
    ASSERT_TRUE(label) << name;
    heights.push_back(label.attribute("y").as_double());
    right = label.attribute("x").as_double();
  }
  for (std::size_t i = 1; i < heights.size(); ++i)
    EXPECT_GE(heights[i] - heights[i - 1], 12.9);
  const double left = 58, top = 10; // of the drawing area
  EXPECT_LE(heights.back(), top + 100 + 4);
  EXPECT_GT(right, left + 200);
  const std::string box = document.child("svg").attribute("viewBox").value();
  EXPECT_GE(std::stod(box.substr(4)), right + 7 * 6); // there is room for the longest
  EXPECT_THAT(text, HasSubstr("M258 60L268 "));       // from the end of the line at 5
}

TEST(Svg, SymbolsHaveSubscriptsAndNamesOfColumnsHaveNone) {
  const auto labelled = [](const char* label) {
    return svg::Plot(100, 50, svg::nice_axis(0, 1, 2, label), svg::nice_axis(0, 1, 2, ""))
        .text("t", "");
  };
  EXPECT_THAT(
      labelled("predicted \u03C4_R / MPa"),
      HasSubstr("\u03C4<tspan dy=\"3\" class=\"sub\">R</tspan><tspan dy=\"-3\"> / MPa</tspan>"));
  EXPECT_THAT(labelled("v_rel / (mm/s)"), HasSubstr("v<tspan dy=\"3\" class=\"sub\">rel</tspan>"));
  for (const std::string column : {"Track_Ra_um", "T_oil"})
    EXPECT_THAT(labelled(column.c_str()), HasSubstr(">" + column + "</text>"));
}

TEST(Svg, LinesAreOneWhereNoPixelIsBetweenThem) {
  const svg::Plot plot(200, 100, svg::nice_axis(0, 1, 2, ""), svg::nice_axis(0, 10, 2, ""));
  const std::vector<double> a{1, 2, 3}, near{1.05, 2, 2.95}, apart{1, 2, 3.2},
      none{1, 2, std::nan("")};
  EXPECT_TRUE(plot.one_line(a, near));
  EXPECT_FALSE(plot.one_line(a, apart));
  EXPECT_FALSE(plot.one_line(a, none));
}

TEST(Svg, AFileHasItsWholeCaption) {
  const svg::Plot plot(100, 50, svg::nice_axis(0, 1, 2, ""), svg::nice_axis(0, 1, 2, ""));
  std::string caption = "law over sigma_n_MPa; held:";
  for (int i = 0; i < 12; ++i)
    caption += " state_" + std::to_string(i) + " = 1234,";
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(plot.file("t", caption).c_str()));
  std::string lines;
  const pugi::xml_node root = document.child("svg");
  for (const pugi::xml_node line : root.children("text")) {
    const std::string text = line.text().get();
    EXPECT_LE(6.2 * static_cast<double>(text.size()), root.attribute("width").as_double());
    EXPECT_LT(line.attribute("y").as_double(), root.child("svg").attribute("y").as_double());
    lines += (lines.empty() ? "" : " ") + text;
  }
  EXPECT_EQ(lines, caption);
}

// WCAG 2: contrast of "#rrggbb" on white.
double contrast_on_white(const std::string& colour) {
  double luminance = 0;
  const double weights[] = {0.2126, 0.7152, 0.0722};
  for (std::size_t c = 0; c < 3; ++c) {
    const double part = std::stoi(colour.substr(1 + 2 * c, 2), nullptr, 16) / 255.0;
    luminance +=
        weights[c] * (part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4));
  }
  return 1.05 / (luminance + 0.05);
}

// tau_R of four values of psi, the last two of which make no difference.
table::Slice slice_over_psi() {
  table::Slice slice;
  slice.model = "law";
  slice.along = {"sigma_n_MPa", "psi"};
  slice.units = {"MPa", "1"};
  slice.fixed = {{"T_contact_C", 100}};
  slice.values = {{500, 1000, 2000}, {1, 2, 4, 5}};
  for (const double sigma : slice.values[0])
    for (const double factor : {0.05, 0.06, 0.08, 0.08001})
      slice.tau_MPa.push_back(factor * sigma);
  return slice;
}

TEST(SlicePlot, NamesEachLineAndThoseThatAreOneOnce) {
  const std::string text = report::slice_svg(slice_over_psi());
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(text.c_str())) << text;
  for (const char* part :
       {">1</text>", ">2</text>", ">4 to 5</text>",
        ">law over sigma_n_MPa, lines: \u03C8; held: T_contact_C = 100</text>", "\u03C3<tspan"})
    EXPECT_THAT(text, HasSubstr(part));
  std::size_t lines = 0;
  for (std::size_t at = 0; (at = text.find("stroke-width=\"2\"", at)) != text.npos; ++at)
    ++lines;
  EXPECT_EQ(lines, 3u);
}

TEST(SlicePlot, DrawsNoLineThatIsLostOnWhite) {
  const std::string text = report::slice_svg(slice_over_psi());
  std::size_t seen = 0;
  for (std::size_t at = 0; (at = text.find("stroke=\"#", at)) != text.npos; ++at, ++seen)
    EXPECT_GE(contrast_on_white(text.substr(at + 8, 7)), 3) << text.substr(at, 16);
  EXPECT_GE(seen, 6u); // three lines, and what leads to their names
}

TEST(Svg, NeighbouringCellsOfAClassAreOneRectangle) {
  svg::Density d{3, 1, {1, 1, 5}, 0};
  svg::Plot plot(30, 10, svg::nice_axis(0, 3, 3, ""), svg::nice_axis(0, 1, 1, ""));
  const std::vector<std::uint32_t> classes{1, 3};
  plot.density(d, classes);
  const std::string text = plot.text("t", "");
  EXPECT_THAT(text, HasSubstr("d=\"M0 0h2v1h-2z\""));
  EXPECT_THAT(text, HasSubstr("d=\"M2 0h1v1h-1z\""));
}

TEST(Svg, BarBeyondItsAxisIsCutAndSaysItsValue) {
  const svg::Axis axis = svg::nice_axis(0, 40, 5, "MPa");
  const std::string text = svg::bar({90, 85, 95, 9, "#888", "law: 90 MPa"}, axis, 200, 20);
  EXPECT_THAT(text, HasSubstr("width=\"200\" height=\"10\""));
  EXPECT_THAT(text, HasSubstr("aria-label=\"law: 90 MPa\""));
  EXPECT_THAT(text, Not(HasSubstr("#111"))); // an interval that cannot be drawn is not drawn
  const std::string edge = svg::bar({38, 36, 44, 9, "#888", "law"}, axis, 200, 20);
  EXPECT_THAT(edge, HasSubstr("d=\"M180 6v8M180 10H200\"")); // goes on beyond: no end cap
}

TEST(Svg, EscapeKeepsGoodUtf8AndReplacesTheRest) {
  EXPECT_EQ(svg::escape("\u03C4 \u2264 \U0001F600"), "\u03C4 \u2264 \U0001F600");
  EXPECT_EQ(svg::escape("a\xC0\x80z"), "a\uFFFD\uFFFDz");       // overlong
  EXPECT_EQ(svg::escape("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD"); // surrogate
  EXPECT_EQ(svg::escape("\xE2\x82"), "\uFFFD\uFFFD");           // cut short
  EXPECT_EQ(svg::escape(std::string_view("\0\x1f", 2)), "\uFFFD\uFFFD");
}

TEST(RunningBand, FollowsTheMedianAndTheOuterTenths) {
  std::vector<double> x, y;
  for (int i = 0; i < 10000; ++i) {
    x.push_back(i);
    y.push_back(0.01 * i + (i * 7919 % 101) - 50); // evenly spread over -50..50
  }
  const report::RunningBand band = report::running_band(x, y);
  ASSERT_GE(band.x.size(), 25u);
  for (std::size_t g = 0; g < band.x.size(); ++g) {
    EXPECT_NEAR(band.median[g], 0.01 * band.x[g], 3);
    EXPECT_NEAR(band.low[g], 0.01 * band.x[g] - 40, 3);
    EXPECT_NEAR(band.high[g], 0.01 * band.x[g] + 40, 3);
  }
}

TEST(RunningBand, IsEmptyForFewRowsAndOnePointForOneAbscissa) {
  const std::vector<double> few(59, 1.0), same(200, 1.0);
  EXPECT_TRUE(report::running_band(few, few).x.empty());
  for (const double x : report::running_band(same, same).x)
    EXPECT_EQ(x, 1.0);
}

TEST(Numbers, HaveSignificantDigitsSeparatorsAndMinus) {
  EXPECT_EQ(figures(12345.6), "12,346");
  EXPECT_EQ(figures(-0.0123456), "\u22120.0123");
  EXPECT_EQ(figures(9.999), "10.0");
  EXPECT_EQ(figures(1.234e-13), "1.23e-13");
  EXPECT_EQ(figures(0), "0");
  EXPECT_EQ(figures(std::nan("")), "\u2013");
  EXPECT_EQ(words::fixed(-0.001, 2), "0.00");
  EXPECT_EQ(words::fixed(-1234567.5, 1), "\u22121,234,567.5");
  EXPECT_EQ(words::short_figures(2750), "2,750");
  EXPECT_EQ(words::short_figures(0.5), "0.5");
}

TEST(Numbers, ValueHasTheDigitsItsErrorAllows) {
  EXPECT_EQ(with_error(0.127634, 0.00052).value, "0.12763");
  EXPECT_EQ(with_error(0.127634, 0.00052).std_error, "0.00052");
  EXPECT_EQ(with_error(1234.5, 12).value, "1,234");
  EXPECT_EQ(with_error(0.5, std::nan("")).value, "0.5000");
  EXPECT_EQ(with_error(0.5, std::nan("")).std_error, "");
}

} // namespace
} // namespace frictab::report_svg_test
