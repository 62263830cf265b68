// Ranking, comparison and errors of laws.
#include "words/laws.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "calibrate/choice.h"
#include "calibrate/comparison.h"
#include "calibrate/influence.h"
#include "calibrate/noise_floor.h"
#include "calibrate/recommended.h"
#include "calibrate/refit.h"
#include "core/no_value.h"
#include "core/text.h"
#include "words/judged.h"
#include "words/numbers.h"
#include "words/published.h"

namespace frictab::words {

using calibrate::Calibration;
using calibrate::ModelFit;

namespace {

Cell with_interval(double value, const calibrate::Interval& interval, int decimals) {
  return {fixed(value, decimals), interval_text(interval, decimals)};
}

const ModelFit* best_of_literature(const Calibration& calibration) {
  for (const ModelFit& fit : calibration.fits)
    if (kind_of(*fit.model.law) == LawKind::literature) return &fit;
  return nullptr;
}

// "the fixed constants of the literature are off by 24 to 95 MPa: even the best of them ... by 4.1
// times as much"
std::string literature_clause(const Calibration& calibration) {
  const auto span = mae_span(calibration, LawKind::literature);
  const ModelFit* best = best_of_literature(calibration);
  if (!span || best == &calibrate::best_fit(calibration)) return "";
  const std::string low = figures(span->low), high = figures(span->high),
                    name = best->model.law->name;
  const double ratio = span->low / calibrate::best_fit(calibration).validation.mae_MPa;
  const bool one = low == high;
  std::string text =
      one ? fmt::format("the fixed constant of the literature ({}) is off by {} MPa", name, low)
          : fmt::format("the fixed constants of the literature are off by {} to {} MPa", low, high);
  if (ratio < 1)
    text +=
        fmt::format(": {} by less than any candidate, which it is where models.use names it", name);
  else if (std::isfinite(ratio))
    text += fmt::format(": {}{} times as much as the best law",
                        one ? "" : fmt::format("even the best of them ({}) by ", name),
                        figures(ratio, 2));
  return text;
}

std::string loss_name(calibrate::Loss loss) {
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

// How the parameters in the ranking were found.
std::string method_text(const Calibration& calibration) {
  std::vector<std::string> methods;
  for (const ModelFit& fit : calibration.fits)
    if (fit.model.law->calibrated != models::Calibrated::fixed && !fit.std_error_method.empty() &&
        std::ranges::find(methods, fit.std_error_method) == methods.end())
      methods.push_back(fit.std_error_method);
  std::string text =
      fmt::format("Loss: {}. Seed {}. Data fingerprint {}.", loss_name(calibration.loss),
                  calibration.seed, calibration.data_hash);
  if (!methods.empty()) text += " Standard errors: " + join(methods, "; ") + ".";
  return text;
}

// Fitted parameters with their standard errors: "mu = 0.0792 \u00B1 0.0020, m = 0.4998"; the size
// of a law with its numbers in the formula.
Text parameters_text(const ModelFit& fit) {
  if (std::string size = calibrate::size_of_trained(fit); !size.empty()) return size;
  const models::Law& law = *fit.model.law;
  const std::size_t n = std::min(law.parameters.size(), fit.model.parameters.size());
  if (n > 8) return fmt::format("{} parameters, in models/{}.json", n, law.name);
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < n; ++i) {
    const double error = i < fit.std_error.size() ? fit.std_error[i] : no_value;
    const bool fixed_law = law.calibrated == models::Calibrated::fixed;
    const ValueText v = fixed_law ? ValueText{short_figures(fit.model.parameters[i]), ""}
                                  : with_error(fit.model.parameters[i], error);
    const models::Parameter& p = law.parameters[i];
    parts.push_back(parameter_text(p.name, v, p.unit));
  }
  return join(parts, ", ");
}

Row law_row(const ModelFit& fit, std::size_t rank, bool best, int decimals) {
  const calibrate::Metrics& v = fit.validation;
  return {{std::to_string(rank),
           {fit.model.law->name, fit.reference ? calibrate::reference_words : ""},
           fixed(v.mae_MPa, decimals),
           interval_text(v.mae_interval, decimals),
           fixed(v.rmse_MPa, decimals),
           fixed(v.bias_MPa, decimals),
           fixed(fit.training.mae_MPa, decimals),
           parameters_text(fit)},
          best ? "best" : ""};
}

// The noise floor, on the same scale as the laws above it.
Row floor_row(const calibrate::NoiseFloor& f, int decimals) {
  return {{"", "noise floor", calibrate::noise_floor_sign(f) + fixed(f.mae_MPa, decimals),
           interval_text(f.mae_interval, decimals), fixed(f.rmse_MPa, decimals), "", "",
           calibrate::noise_floor_name(f) + calibrate::noise_floor_limits(f)},
          "floor"};
}

Table ranking_table(const Calibration& calibration) {
  const int decimals = error_decimals(calibration);
  Table table{"Ranking",
              {number_column("#"),
               {"law"},
               number_column("MAE", "", "strong"),
               number_column("95 % interval"),
               number_column("RMSE"),
               number_column("bias"),
               number_column("train MAE"),
               {"parameters \u00B1 standard error", false, "", Shown::everywhere, "parameters"}},
              {},
              "ranking",
              1};
  for (std::size_t i = 0; i < calibration.fits.size(); ++i)
    table.rows.push_back(
        law_row(calibration.fits[i], i + 1, i == calibrate::best_place(calibration), decimals));
  if (!calibration.noise_floors.empty())
    table.rows.push_back(floor_row(calibration.noise_floors.front(), decimals));
  return table;
}

// One item per reason: "skipped, needs sigma_f_MPa: levanov, shaw".
List left_out_laws(const Calibration& calibration) {
  std::map<std::string, std::vector<std::string>> laws;
  for (const calibrate::LeftOut& left : calibration.left_out)
    laws[left.needs].push_back(left.law);
  List list;
  for (const auto& [reason, names] : laws)
    list.items.push_back(fmt::format("skipped, needs {}: {}", reason, join(names, ", ")));
  return list;
}

List remarks_on(const Calibration& calibration) {
  List list{{}, "remarks"};
  if (const std::string one = calibrate::influence_sentence(calibration); !one.empty())
    list.items.push_back("influence: " + one);
  for (const ModelFit& fit : calibration.fits)
    for (const std::string& remark : fit.remarks)
      list.items.push_back(fit.model.law->name + ": " + remark);
  return list;
}

} // namespace

Section ranking(const Calibration& c, Detail detail) {
  Section section{"ranking", "Ranking", judged_words(c.judged_by).ranking + " (tau_R, MPa)"};
  if (c.fits.empty()) {
    section.title = "Ranking of the laws";
    section.say("No law was calibrated.");
    section.add(left_out_laws(c));
    return section;
  }
  const calibrate::Metrics& t = c.fits.front().training;
  const int decimals = error_decimals(c);
  section.say(
      fmt::format(
          "Calibrated on {} of {}, {}. Residual = measured \u2212 predicted: a positive bias says "
          "that the law predicts too little friction. Intervals are 95 %, from resampling whole "
          "experiments. The noise floor is the scatter that no law of these columns can predict.",
          count_of(t.n_rows, "row"), count_of(t.n_experiments, "experiment"), judged_text(c)),
      "", Shown::on_pages);
  section.add(ranking_table(c));
  if (const std::string advice = calibrate::noise_floor_advice(c); !advice.empty())
    section.say(
        sentence((c.noise_floors.empty()               ? "noise floor unknown: "
                  : c.noise_floors.front().lower_bound ? "noise floor known as a lower bound only: "
                                                       : "noise floor too high: ") +
                 advice));
  if (const std::string pairs = calibrate::pairwise_sentence(c.comparisons); !pairs.empty())
    section.say(sentence("pair by pair, " + pairs));
  const bool named = detail != Detail::brief;
  if (const std::string family = calibrate::family_sentence(c.comparisons, named); !family.empty())
    section.say(sentence(family + (named || calibrate::possibly_best(c.comparisons).size() == 1
                                       ? ""
                                       : "; names with -v")));
  section.say(sentence(calibrate::share_sentence(c.choice)));
  section.say(sentence(calibrate::recommended_sentence(c, decimals)));
  section.say(sentence(calibrate::expectation_sentence(c, decimals)));
  section.say(sentence(literature_clause(c)));
  section.say(sentence(calibrate::delivery_sentence(c, decimals)));
  section.add(remarks_on(c));
  section.add(left_out_laws(c));
  section.say(method_text(c), "small", Shown::in_html);
  return section;
}

Section delivered_laws(const Calibration& c) {
  const int decimals = error_decimals(c);
  Table table{"Delivered laws",
              {{"delivered law"},
               number_column("cross-validated MAE"),
               number_column("95 % interval"),
               number_column("RMSE"),
               number_column("bias"),
               {"parameters \u00B1 standard error", false, "", Shown::everywhere, "parameters"}}};
  List remarks;
  for (const ModelFit& judged : c.fits) {
    if (!judged.on_all) continue;
    const ModelFit& fit = *judged.on_all;
    const calibrate::Metrics& v = fit.validation;
    table.rows.push_back(
        {{fit.model.law->name, fixed(v.mae_MPa, decimals), interval_text(v.mae_interval, decimals),
          fixed(v.rmse_MPa, decimals), fixed(v.bias_MPa, decimals), parameters_text(fit)}});
    for (const std::string& remark : fit.remarks)
      remarks.items.push_back(fit.model.law->name + ": " + remark);
  }
  Section section{"", "", "The laws as they are delivered"};
  section.shown = Shown::on_pages;
  if (table.rows.empty()) return section;
  section.add(std::move(table));
  section.add(std::move(remarks));
  return section;
}

namespace {

// Three classes that differ by shade and by the cell's own sign.
const char* shade_of(const calibrate::Difference& d) {
  if (d.p_value < 0.001) return "clear";
  return d.distinguishable() ? "better" : "open";
}

Cell pair_cell(const calibrate::Comparison& pair, int decimals) {
  const calibrate::Difference &mae = pair.mae, &rmse = pair.rmse;
  const std::string value = fixed(mae.value_MPa, std::max(0, decimals - 1));
  Cell cell = mae.distinguishable() ? Cell(strong(value)) : Cell(value);
  cell.kind = shade_of(mae);
  cell.hover =
      fmt::format("{} against {}: {} MPa, 95 % {}, p {}; RMSE: {} MPa, 95 % {}, p {}", pair.law,
                  pair.other, fixed(mae.value_MPa, decimals), interval_text(mae.interval, decimals),
                  p_text(mae.p_value), fixed(rmse.value_MPa, decimals),
                  interval_text(rmse.interval, decimals), p_text(rmse.p_value));
  return cell;
}

// By how much each law is worse than the best one, with the probability that it is the best.
Table worse_than_best(const calibrate::Comparisons& c, int decimals) {
  Table table{"Laws compared with the best",
              {{"law"},
               number_column("MAE above the best"),
               number_column("p"),
               number_column("RMSE above it"),
               number_column("p"),
               {"verdict"},
               {"may be the best"}}};
  for (std::size_t j = 0; j < c.laws.size(); ++j) {
    const double p = c.best_p_values[j];
    const std::string may = std::isnan(p)
                                ? calibrate::reference_words
                                : fmt::format("{} (p {})", p < 0.05 ? "no" : "yes", p_text(p));
    if (j == 0) {
      table.rows.push_back({{c.laws[j], "", "", "", "", "", may}});
      continue;
    }
    const calibrate::Comparison& pair = c.pairs[j - 1];
    table.rows.push_back(
        {{c.laws[j], with_interval(pair.mae.value_MPa, pair.mae.interval, decimals),
          p_text(pair.mae.p_value),
          with_interval(pair.rmse.value_MPa, pair.rmse.interval, decimals),
          p_text(pair.rmse.p_value), pair.mae.distinguishable() ? "worse" : "not distinguishable",
          may}});
  }
  return table;
}

// A triangle: law j in row j, with a cell for every law ranked before it.
Table all_pairs(const calibrate::Comparisons& c, int decimals) {
  Table table{"Pairs of laws", {{"law"}}, {}, "matrix"};
  for (std::size_t i = 1; i < c.laws.size(); ++i)
    table.columns.push_back(number_column(std::to_string(i)));
  for (std::size_t j = 0; j < c.laws.size(); ++j) {
    Row row{{fmt::format("{} {}", j + 1, c.laws[j])}};
    for (const calibrate::Comparison& pair : c.pairs)
      if (pair.other == c.laws[j]) row.cells.push_back(pair_cell(pair, decimals));
    row.cells.resize(c.laws.size());
    table.rows.push_back(std::move(row));
  }
  return table;
}

} // namespace

Section comparison(const Calibration& calibration) {
  const calibrate::Comparisons& c = calibration.comparisons;
  Section section{"comparison", "Comparison", "Is law A better than law B?"};
  if (c.laws.size() < 2) {
    section.say("Nothing was compared: it takes two laws, two validation experiments and "
                "calibration.bootstrap > 0.");
    return section;
  }
  const int decimals = error_decimals(calibration);
  section.say(fmt::format(
      "Paired by experiment: both laws on the same {} resamples of the {}. Intervals and p-values "
      "are of one pair each; of many pairs, one in twenty is below 0.05 by chance where laws are "
      "equal. The last column is for all candidates together and allows for the data having chosen "
      "the leader: p of \"no law is better than this one\".",
      thousands(c.resamples), count_of(c.n_experiments, "validation experiment")));
  section.add(worse_than_best(c, decimals));
  section.say(
      "All pairs: by how many MPa the MAE of the row's law is larger than that of the column's "
      "law; " +
      strong("bold and shaded") +
      " where the column's law is better (p < 0.05 for that pair alone, darker below 0.001).");
  section.add(all_pairs(c, decimals));
  return section;
}

namespace {

std::string meaning_of(const calibrate::NoiseFloor& floor) {
  if (floor.measured_MPa > 0) return "lowered to what the best law errs";
  return floor.lower_bound ? "lower bound: scatter between experiments not included"
                           : "no law of the state can do better on average";
}

Table floors_table(const Calibration& calibration, int decimals) {
  Table table{"Noise floor",
              {{"noise floor from"},
               {"part"},
               number_column("MAE"),
               number_column("RMSE"),
               {"data"},
               {"meaning"}}};
  for (const calibrate::NoiseFloor& f : calibration.noise_floors)
    table.rows.push_back(
        {{calibrate::noise_floor_name(f), f.part,
          with_interval(f.mae_MPa, f.mae_interval, decimals),
          with_interval(f.rmse_MPa, f.rmse_interval, decimals),
          count_of(f.n_rows, "row") + " of " + count_of(f.n_experiments, "experiment"),
          meaning_of(f)}});
  return table;
}

Row errors_row(const ModelFit& fit, int decimals) {
  Row row{{fit.model.law->name}};
  for (const calibrate::Metrics* m : {&fit.validation, &fit.training}) {
    row.cells.push_back(with_interval(m->mae_MPa, m->mae_interval, decimals));
    row.cells.push_back(with_interval(m->rmse_MPa, m->rmse_interval, decimals));
    row.cells.push_back(with_interval(m->bias_MPa, m->bias_interval, decimals));
  }
  return row;
}

} // namespace

Section all_errors(const Calibration& c) {
  Section section{"errors", "All errors", "All errors and the noise floor"};
  const int decimals = error_decimals(c);
  if (!c.fits.empty()) {
    section.say("MPa, with 95 % intervals by experiment (bootstrap-t).");
    Table table{"All errors", {{"law"}}, {}, "errors"};
    for (const char* part : {"validation", "training"})
      for (const char* error : {"MAE", "RMSE", "bias"})
        table.columns.push_back(number_column(error, part));
    for (const ModelFit& fit : c.fits)
      table.rows.push_back(errors_row(fit, decimals));
    section.add(std::move(table));
    if (!c.validation_experiments.empty())
      section.say("Validation experiments: " + join(c.validation_experiments, ", ") + ".", "small");
  }
  const std::string advice = calibrate::noise_floor_advice(c);
  section.say("Irreducible error, which even an exact law of the state would have: " +
              calibrate::noise_floor_sentence(c, decimals) + (advice.empty() ? "" : "; " + advice) +
              ".");
  if (!c.noise_floors.empty()) section.add(floors_table(c, decimals));
  return section;
}

Section experiment_band(const Calibration& c) {
  Section section{"band", "Band", "The band of experiments"};
  if (c.fits.empty()) return section;
  section.say(band_sentence);
  Table table{"Band of experiments",
              {{"law"},
               number_column("5 % below"),
               number_column("95 % below"),
               number_column("validation experiments inside")}};
  for (const ModelFit& fit : c.fits)
    table.rows.push_back({{fit.model.law->name, factor_text(fit.band.low),
                           factor_text(fit.band.high), inside_text(fit.band)}});
  section.add(std::move(table));
  return section;
}

Section polynomial_terms(const Calibration& c) {
  constexpr std::size_t most_terms = 15; // the largest come first
  Section section{"polynomial", "Polynomial", "What the polynomial is made of"};
  const auto fit = std::ranges::find_if(
      c.fits, [](const ModelFit& one) { return one.polynomial && !one.polynomial->terms.empty(); });
  if (fit == c.fits.end()) return section;
  const calibrate::PolynomialRecord& record = *fit->polynomial;
  const std::size_t shown = std::min(most_terms, record.terms.size());
  section.say(fmt::format(
      "ln mu = ln mu0 + the sum of b times its term; each z runs from -1 to 1 over the data, P2 = "
      "(3 z\u00B2 - 1)/2, P3 = (5 z\u00B3 - 3 z)/2, so that a term moves ln mu by b at most. "
      "Errors by experiment, the ridge held. The {} largest of {} terms{}.",
      shown, record.terms.size(),
      shown < record.terms.size() ? "; all are in calibration.json" : ""));
  Table table{"Terms of the polynomial",
              {{"term"}, number_column("b"), number_column("standard error")}};
  for (std::size_t t = 0; t < shown; ++t) {
    const calibrate::PolynomialTerm& term = record.terms[t];
    const ValueText v = with_error(term.coefficient, term.std_error);
    table.rows.push_back({{term.text, v.value, v.std_error.empty() ? "\u2013" : v.std_error}});
  }
  section.add(std::move(table));
  List coordinates{{}, "small"};
  for (const std::string& coordinate : record.coordinates)
    coordinates.items.emplace_back(coordinate);
  section.add(std::move(coordinates));
  return section;
}

Section published_comparison(const Calibration& calibration) {
  Section section{"published", "Published figures", "Published figures and yours"};
  if (!is_cold_forging(calibration)) return section;
  section.say(published_warning);
  Table table{"Published figures",
              {{"mean absolute error of tau_R"},
               number_column("published, MPa", "", "published"),
               number_column("here, MPa")}};
  const auto all = published_figures();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string ours = counterpart(calibration, i);
    table.rows.push_back({{all[i].what, all[i].mae_MPa, ours.empty() ? "\u2013" : ours}});
  }
  section.add(std::move(table));
  section.say("Published: " + emphasis(published_source) +
                  ". Here: validation experiments of this job.",
              "small");
  return section;
}

Section conditional_use(const Calibration& calibration) {
  const calibrate::Conditional& c = calibration.conditional;
  Section section{"conditional", "Conditional use",
                  "Conditional use: part of every test predicts its rest"};
  if (c.laws.empty()) return section;
  const int decimals = error_decimals(calibration);
  const std::string length = short_figures(c.condition_on_mm);
  section.say(strong("Not to be compared with the ranking.") +
                  fmt::format(" Each law times one gain per experiment, predicted from how far "
                              "that experiment's own first {0} mm of sliding are off from what is "
                              "usual there; how far to trust them is learned from the training "
                              "experiments. Errors on the rows beyond {0} mm only, in MPa. {1}",
                              length, conditional_counts(c)),
              "aside");
  Table table{"Conditional use",
              {{"law"},
               number_column("MAE without gain"),
               number_column("MAE with gain"),
               number_column("RMSE with gain"),
               number_column("bias with gain"),
               number_column("gained"),
               number_column("share of the deviation used")},
              {},
              "errors"};
  for (const calibrate::ConditionalFit& fit : c.laws)
    table.rows.push_back(
        {{fit.law, fixed(fit.unconditional.mae_MPa, decimals),
          with_interval(fit.conditional.mae_MPa, fit.conditional.mae_interval, decimals),
          with_interval(fit.conditional.rmse_MPa, fit.conditional.rmse_interval, decimals),
          fixed(fit.conditional.bias_MPa, decimals),
          with_interval(fit.gain.value_MPa, fit.gain.interval, decimals),
          fixed(100 * fit.trust, 0) + " %"}});
  section.add(std::move(table));
  return section;
}

} // namespace frictab::words
