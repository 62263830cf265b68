// Effects of closed form, one row each.
#include <algorithm>

#include "effects/effect.h"

namespace frictab::effects {

namespace {

using models::Parameter;

// ---- measures of shape parameters ----

constexpr auto median = [](const Spread& s) { return s.median; };
constexpr auto low = [](const Spread& s) { return s.low; };
constexpr auto span = [](const Spread& s) { return s.span(); };
constexpr auto sixth_of_span = [](const Spread& s) { return s.span() / 6.0; };
constexpr auto range = [](const Spread& s) { return s.maximum - s.minimum; };
constexpr auto maximum = [](const Spread& s) { return s.maximum; };
constexpr auto maximum_or_span = [](const Spread& s) {
  return s.maximum > 0 ? s.maximum : s.span();
};
constexpr auto positive = [](const Spread& s) { return s.positive(); };
constexpr auto one = [](const Spread&) { return 1.0; };

Shape fitted(Measure measure, double share = 1) {
  return {.measure = measure, .share = share};
}
Shape kept(Measure measure, double share = 1) {
  return {.measure = measure, .share = share, .fitted = false};
}
Shape trying(Shape shape, Measure measure, std::vector<double> shares) {
  shape.tried_measure = measure;
  shape.tried_shares = std::move(shares);
  return shape;
}
Shape at_positions(std::size_t count, Shape shape = fitted(median)) {
  shape.positions = count;
  return shape;
}

// ---- common parameters: an amplitude, a value of x or x2, a distance along it ----

struct ShapeRow {
  Parameter parameter;
  Shape shape;
};

Parameter amplitude(const char* meaning, double bound = 10) {
  return {"a", "1", meaning, 0, -bound, bound};
}
Parameter place(const char* name, const char* input, const char* meaning, double start = 0) {
  return {name, input, meaning, start, -1e12, 1e12};
}
Parameter distance(const char* name, const char* input, const char* meaning, double start = 1) {
  return {name, input, meaning, start, 1e-12, 1e12};
}

ShapeRow reference(const char* name = "x0", const char* input = "x",
                   const char* meaning = "reference: the factor is 1 there") {
  return {place(name, input, meaning, 1), kept(median)};
}
ShapeRow positive_reference() {
  return {distance("x0", "x", "reference: the factor is 1 there"), kept(positive)};
}
ShapeRow scale(const char* name = "w", const char* input = "x", double share = 1,
               const char* meaning = "scale, so that the amplitude has no unit") {
  return {distance(name, input, meaning), kept(span, share)};
}

const char* const second_reference = "reference of the second quantity";
const char* const second_scale = "scale of the second quantity";

// ---- grids of shapes that depend on each other ----

// Tries wavelengths from twice the range to a fifteenth of it, with two phases each.
std::vector<std::vector<double>> waves(const Spread& s) {
  std::vector<std::vector<double>> shapes;
  for (int i = 0; i < 24; ++i) {
    const double wave = range(s) / (0.5 + 0.6 * i);
    shapes.push_back({s.minimum, wave});
    shapes.push_back({s.minimum + 0.25 * wave, wave});
  }
  return shapes;
}

constexpr double half_turn = 180; // period in degrees of a lay without direction

// Tries periods of half a turn and of a turn, with phases over half a period in steps of 1/16; the
// other half only changes the sign.
std::vector<std::vector<double>> turns(const Spread&) {
  std::vector<std::vector<double>> shapes;
  for (const double turn : {half_turn, 2 * half_turn})
    for (int i = 0; i < 8; ++i)
      shapes.push_back({turn * i / 16, turn});
  return shapes;
}

// ---- the table ----

using Grid = std::vector<std::vector<double>> (*)(const Spread&);

// `people`: the formula in the notation of papers; `factor`: of x, x2, x3 and the parameters, of
// which `first` is the amplitude.
EffectForm closed_form(const char* name, int order, const char* title, const char* people,
                       const char* factor, Parameter first, const std::vector<ShapeRow>& shapes,
                       Grid grid = nullptr) {
  EffectForm form;
  form.name = name;
  form.order = order;
  form.title = title;
  form.formula = people;
  form.factor = expr::parse_expr(factor);
  form.parameters = {std::move(first)};
  form.grid = grid;
  for (const auto& [parameter, shape] : shapes) {
    form.parameters.push_back(parameter);
    form.shapes.push_back(shape);
    if (parameter.unit == "x2" || parameter.unit == "x3") {
      form.shapes.back().input = parameter.unit == "x2" ? 1 : 2;
      form.columns = std::max(form.columns, form.shapes.back().input + 1);
    }
  }
  return form;
}

std::vector<EffectForm> closed_forms() {
  return {
      // x stops at a thousandth of the reference, because 0 to a negative power is infinite.
      closed_form("power", 1, "power of x", "(max(x, 0.001 x0)/x0)^a", "max(x/x0, 0.001)^a",
                  amplitude("exponent"), {positive_reference()}),
      // Softening or hardening at a constant relative rate.
      closed_form("exponential", 2, "exponential of x", "exp(a (x - x0)/w)", "exp(a*((x - x0)/w))",
                  amplitude("relative rate over w"), {reference(), scale()}),
      closed_form("linear", 3, "linear in x", "1 + a (x - x0)/w", "1 + a*((x - x0)/w)",
                  amplitude("relative change over w"), {reference(), scale()}),
      // Rate effects act over decades; x stops at the same value as in the power.
      closed_form("logarithmic", 4, "logarithm of x", "1 + a ln(max(x, 0.001 x0)/x0)",
                  "1 + a*log(max(x/x0, 0.001))", amplitude("relative change per e-fold"),
                  {positive_reference()}),
      // The temperature stops one kelvin above absolute zero.
      closed_form("arrhenius", 5, "thermal activation, x in degC",
                  "exp(a ((x0 + 273.15)/(x + 273.15) - 1))",
                  "exp(a*((x0 + 273.15)/max(x + 273.15, 1) - 1))",
                  amplitude("activation energy over R T0", 100),
                  {{{"x0", "x", "reference temperature: the factor is 1 there", 20, -272, 1e4},
                    kept(median)}}),
      // Running-in, depletion of a film.
      closed_form("saturation", 6, "saturating growth", "1 + a (1 - exp(-max(x, 0)/x0))",
                  "1 + a*(1 - exp(-(max(x, 0)/x0)))",
                  amplitude("relative change reached in the end"),
                  {{distance("x0", "x", "distance over which 63 % is reached"),
                    trying(fitted(span, 0.25), range, {0.02, 0.05, 0.12, 0.3, 0.8})}}),
      closed_form("hinge", 7, "straight line after a threshold", "1 + a max(x - x0, 0)/w",
                  "1 + a*(max(x - x0, 0)/w)", amplitude("relative change over w"),
                  {{place("x0", "x", "threshold"), at_positions(9)}, scale("w", "x", 0.5)}),
      // A film that breaks down, a phase that changes.
      closed_form("step", 8, "smooth step", "1 + a (1 + tanh((x - x0)/w))/2",
                  "1 + a*(0.5*(1 + tanh((x - x0)/w)))",
                  amplitude("relative change across the step"),
                  {{place("x0", "x", "place of the step"), at_positions(9)},
                   {distance("w", "x", "half width of the step"),
                    trying(fitted(span, 0.125), range, {0.08})}}),
      // A hot spot in temperature, a resonance in speed.
      closed_form("bump", 9, "bump", "1 + a exp(-((x - x0)/w)^2/2)",
                  "1 + a*exp(-0.5*(((x - x0)/w)*((x - x0)/w)))", amplitude("relative height"),
                  {{place("x0", "x", "place of the bump"), at_positions(8)},
                   {distance("w", "x", "width (standard deviation)"),
                    trying(fitted(sixth_of_span), range, {0.06, 0.15})}}),
      // Falling boundary friction and rising viscous friction over the speed.
      closed_form(
          "stribeck", 10, "Stribeck curve", "1 + a (exp(-max(x, 0)/x0) + max(x, 0)/x1)",
          "1 + a*(exp(-(max(x, 0)/x0)) + max(x, 0)/x1)",
          amplitude("relative height of the boundary branch"),
          {{distance("x0", "x", "speed at which the boundary branch has fallen to 1/e"),
            trying(fitted(positive, 0.5), maximum, {0.03, 0.1, 0.3})},
           {distance("x1", "x", "speed at which the viscous branch reaches the same height"),
            trying(fitted(maximum_or_span, 2), maximum, {0.5, 2})}}),
      // Eccentric tools, stick-slip, machining marks.
      closed_form("periodic", 11, "wave", "1 + a sin(2 pi (x - x0)/w)",
                  "1 + a*sin(6.283185307179586*((x - x0)/w))", amplitude("relative amplitude"),
                  {{place("x0", "x", "a place where the wave rises through zero"), fitted(low)},
                   {distance("w", "x", "wavelength"), fitted(span, 0.3)}},
                  waves),
      closed_form("product", 13, "product of two quantities", "1 + a (x - x0)/w (x2 - y0)/w2",
                  "1 + a*((x - x0)/w*((x2 - y0)/w2))", amplitude("relative change over w and w2"),
                  {reference(), scale(), reference("y0", "x2", second_reference),
                   scale("w2", "x2", 1, second_scale)}),
      // Lowest or highest friction at an optimum.
      closed_form("parabola", 14, "U-shape about an optimum", "1 + a ((x - x0)/w)^2",
                  "1 + a*((x - x0)/w*((x - x0)/w))",
                  amplitude("relative change at a distance of w"),
                  {{place("x0", "x", "optimum"), at_positions(5)}, scale()}),
      // x is the load over its peak so far, 1 while loading: flattened asperities stay flat, and
      // trapped lubricant stays trapped.
      closed_form("hysteresis", 15,
                  "direction of load: another friction below the peak pressure so far",
                  "1 + a min((1 - x)/w, 1)", "1 + a*min(1, max(1 - x, 0)/w)",
                  amplitude("relative change once the load has fallen by w"),
                  {{{"w", "x", "part of the peak load by which it has to fall", 0.2, 1e-3, 1e12},
                    trying(fitted(one, 0.2), one, {0.05, 0.2, 0.6})}}),
      // The colder the tool, the longer the slide before it galls.
      closed_form("threshold2", 17, "threshold in two quantities",
                  "1 + a max((x - x0)/w + b (x2 - y0)/w2, 0)",
                  "1 + a*max((x - x0)/w + b*((x2 - y0)/w2), 0)",
                  amplitude("relative change over w"),
                  {{place("x0", "x", "threshold of x where x2 is y0"), at_positions(5)},
                   scale("w", "x", 0.5),
                   {{"b", "1", "what w2 of x2 counts in w of x", 0.5, -10, 10},
                    trying(fitted(one, 0.5), one, {-1, -0.4, 0.4, 1})},
                   {place("y0", "x2", second_reference), kept(median)},
                   scale("w2", "x2", 1, second_scale)}),
      // A change during a pause before the slide, which sliding wears off again: a lubricant film
      // that recovers, an oxide that grows, a junction that ages.
      closed_form("recovery", 18, "recovery over a pause, lost again by sliding",
                  "1 + a exp(-max(x, 0)/x0) exp(-max(x2, 0)/t0)",
                  "1 + a*(exp(-(max(x, 0)/x0))*exp(-(max(x2, 0)/t0)))",
                  amplitude("relative change at the start of a slide without a pause before it"),
                  {{distance("x0", "x", "sliding distance over which it falls to 1/e"),
                    trying(fitted(span, 0.2), range, {0.03, 0.1, 0.3})},
                   {distance("t0", "x2", "pause over which it falls to 1/e"),
                    trying(fitted(span, 0.3), range, {0.1, 0.3, 1})}}),
      closed_form("product3", 19, "product of three quantities",
                  "1 + a (x - x0)/w (x2 - y0)/w2 (x3 - z0)/w3",
                  "1 + a*((x - x0)/w*((x2 - y0)/w2)*((x3 - z0)/w3))",
                  amplitude("relative change over w, w2 and w3"),
                  {reference(), scale(), reference("y0", "x2", second_reference),
                   scale("w2", "x2", 1, second_scale),
                   reference("z0", "x3", "reference of the third quantity"),
                   scale("w3", "x3", 1, "scale of the third quantity")}),
      // Along and across the lay of a surface or the rolling direction.
      closed_form(
          "cosine", 23, "cosine of an angle", "1 + a cos(2 pi (x - x0)/w)",
          "1 + a*sin(6.283185307179586*((x - x0)/w + 0.25))", amplitude("relative amplitude"),
          {{place("x0", "x", "angle of the largest (a < 0: smallest) friction"), fitted(one, 0)},
           {distance("w", "x", "turn after which it repeats", half_turn), kept(one, half_turn)}},
          turns),
      closed_form(
          "ramp", 24, "straight line between two thresholds", "1 + a min(max((x - x0)/w, 0), 1)",
          "1 + a*min(max((x - x0)/w, 0), 1)", amplitude("relative change across the ramp"),
          {{place("x0", "x", "where the ramp begins"), at_positions(7)},
           {distance("w", "x", "its width"), trying(fitted(span, 0.25), span, {0.25, 0.5})}})};
}

const Registered<EffectForm> registered{closed_forms};

} // namespace
} // namespace frictab::effects
