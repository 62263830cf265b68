// Puts the parts of a judgement together.
#include "process/process.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "calibrate/comparison.h"
#include "calibrate/recommended.h"
#include "core/parallel.h"
#include "core/text.h"
#include "data/quantity.h"
#include "models/assembled_law.h"
#include "process/smooth.h"
#include "table/distance.h"

namespace frictab::process {

using calibrate::ModelFit;
using data::Dataset;

namespace {

constexpr double best_share = 0.005; // of resamples in which a law that leads is best
constexpr double near_slack = 1.25;  // of the least error near the process
constexpr double work_slack = 5;     // %, of the solver's friction work

// ---- what the laws need ----

void hold_inputs(ContactHistory& history, const Tests& tests, const models::Conventions& k) {
  std::set<std::string> inputs;
  std::map<std::string, std::vector<std::string>> levels;
  for (const ModelFit& fit : tests.calibration.fits) {
    const models::Law& law = *fit.delivered().model.law;
    for (const std::string& name : models::inputs(law, fit.delivered().model.conventions))
      inputs.insert(name);
    levels.insert(law.levels.begin(), law.levels.end());
  }
  for (const std::string& name : smooth_states(tests.all))
    inputs.insert(name);
  if (k.shear_limit) inputs.insert("sigma_f_MPa");
  const std::vector<std::string> all(inputs.begin(), inputs.end());
  hold_missing(history, all, levels, tests.training);
}

// ---- checks ----

struct Driving {
  Prediction prediction = Prediction::force;
  bool found = false;
};

// Whether the force is a straight line over the late half while the speed is not steady.
bool looks_force_driven(const ContactHistory& h) {
  constexpr double straight = 0.002, unsteady = 0.05;
  const std::vector<std::size_t> late = h.late();
  if (late.size() < 5) return false;
  const double n = static_cast<double>(late.size());
  double t = 0, f = 0, v = 0;
  for (const std::size_t i : late) {
    t += h.time_s[i] / n;
    f += h.tool->force_kN[i] / n;
    v += h.tool->speed_mm_s[i] / n;
  }
  double tt = 0, tf = 0, vv = 0;
  for (const std::size_t i : late) {
    tt += (h.time_s[i] - t) * (h.time_s[i] - t);
    tf += (h.time_s[i] - t) * (h.tool->force_kN[i] - f);
    vv += (h.tool->speed_mm_s[i] - v) * (h.tool->speed_mm_s[i] - v);
  }
  double off = 0;
  for (const std::size_t i : late) {
    const double r = h.tool->force_kN[i] - f - tf / tt * (h.time_s[i] - t);
    off += r * r;
  }
  return std::sqrt(off / n) < straight * f && std::sqrt(vv / n) > unsteady * v;
}

Driving driving_of(const ContactHistory& h, const ProcessOptions& options) {
  if (!options.fixed_contact) return {Prediction::contact_changes};
  switch (options.driven) {
  case Driven::force:
    return {Prediction::force_driven};
  case Driven::energy:
    return {Prediction::energy_driven};
  case Driven::displacement:
    return {h.tool ? Prediction::force : Prediction::no_tool};
  case Driven::automatic:
    break;
  }
  if (!h.tool) return {Prediction::no_tool};
  if (looks_force_driven(h)) return {Prediction::force_driven, true};
  return {};
}

// Compares the friction work with that of the solver and of the tool.
void check_work(Process& p, const ProcessOptions& options) {
  const double work = std::accumulate(p.work_J.begin(), p.work_J.end(), 0.0);
  if (!(work > 0))
    throw InputError(p.history.place(), "there is no friction work: nothing slides under stress",
                     "are v_rel_mm_s and tau_R_MPa those of the contact?");
  if (!p.history.tool) return;
  const Tool& tool = *p.history.tool;
  if (tool.friction_J && *tool.friction_J > 0) {
    p.work_check_percent = 100 * (work / *tool.friction_J - 1);
    const double times = *tool.friction_J / work;
    const double whole = std::round(std::max(times, 1 / times));
    const bool is_symmetry =
        whole >= 2 && whole <= 16 && std::abs(std::max(times, 1 / times) / whole - 1) < 0.06;
    const double symmetry = options.symmetry * (times > 1 ? whole : 1 / whole);
    if (std::abs(*p.work_check_percent) > work_slack)
      throw InputError(p.history.place(),
                       fmt::format("the friction work of these contacts is {:.4g} J, that of the "
                                   "solver {:.4g} J ({:+.1f} %)",
                                   work, *tool.friction_J, *p.work_check_percent),
                       is_symmetry
                           ? fmt::format("--symmetry {:g}? The areas are of another part of the "
                                         "process than the tool's file",
                                         symmetry)
                           : "a contact pair that is missing, areas of the undeformed mesh, other "
                             "units, or too few increments? The sum is tau v A dt");
  }
  double of_tool = 0;
  for (std::size_t i = 0; i < p.history.time_s.size(); ++i)
    of_tool += tool.force_kN[i] * tool.speed_mm_s[i] * p.history.step(i); // kN mm = J
  if (!(of_tool > 0)) return;
  p.work_share_percent = 100 * work / of_tool;
  if (p.work_share_percent > 105)
    throw InputError(
        p.history.place(),
        fmt::format("friction takes {:.3g} J, more than the {:.3g} J that the tool gives", work,
                    of_tool),
        "--symmetry, or units: sigma_n_MPa, area_mm2, v_rel_mm_s, force_kN, speed_mm_s");
}

// ---- nearness of tests to the process ----

constexpr std::size_t near_rows = 40;    // of each test
constexpr std::size_t near_states = 400; // of the process
constexpr double near_width = 0.15;      // of the tests' span
constexpr double least_relative_MPa = 5; // of a stress that errors are relative to

struct NearRows {
  std::vector<std::size_t> rows;
  std::vector<double> weight;
};

NearRows near_process(const ContactHistory& h, std::span<const double> work_J,
                      const Coverage& coverage, const Dataset& tests) {
  NearRows near;
  for (std::size_t e = 0; e < tests.experiments.size(); ++e)
    for (const std::size_t row : some_rows(tests.first_row[e], tests.first_row[e + 1], near_rows))
      near.rows.push_back(row);
  near.weight.assign(near.rows.size(), 0.0);
  if (coverage.states.empty()) {
    near.weight.assign(near.rows.size(), 1.0);
    return near;
  }
  const std::vector<std::size_t> drawn = drawn_by_work(work_J, near_states);
  const std::size_t dims = coverage.states.size();
  std::vector<double> here(drawn.size() * dims), there(near.rows.size() * dims);
  for (std::size_t s = 0; s < dims; ++s) {
    const StateCoverage& state = coverage.states[s];
    const bool log = data::find_quantity(state.state)->log_axis && state.tested_low > 0;
    const auto u = [&](double x) { return log ? std::log(std::max(x, 1e-3)) : x; };
    const double span = u(state.tested_high) - u(state.tested_low);
    const auto process = h.states.values(state.state), test = tests.values(state.state);
    for (std::size_t i = 0; i < drawn.size(); ++i)
      here[i * dims + s] = u(process[drawn[i]]) / span;
    for (std::size_t i = 0; i < near.rows.size(); ++i)
      there[i * dims + s] = u(test[near.rows[i]]) / span;
  }
  parallel_for(near.rows.size(), [&](std::size_t i) {
    for (std::size_t j = 0; j < drawn.size(); ++j) {
      double square = 0;
      for (std::size_t s = 0; s < dims; ++s) {
        const double d = there[i * dims + s] - here[j * dims + s];
        square += d * d;
      }
      near.weight[i] += std::exp(-square / (2 * near_width * near_width));
    }
    if (!std::isfinite(near.weight[i])) near.weight[i] = 0;
  });
  return near;
}

// Mean relative error of a law on the tests' rows, by nearness.
double near_error(const NearRows& near, std::span<const double> predicted,
                  std::span<const double> measured) {
  double sum = 0, all = 0;
  for (std::size_t i = 0; i < near.rows.size(); ++i) {
    const double tau = measured[near.rows[i]];
    if (!std::isfinite(tau)) continue;
    sum += near.weight[i] * std::abs(predicted[near.rows[i]] - tau) /
           std::max(tau, least_relative_MPa);
    all += near.weight[i];
  }
  return all > 0 ? sum / all : 0;
}

// ---- the assessment ----

double share_of(const std::vector<calibrate::Choice::Share>& shares, const std::string& law) {
  for (const calibrate::Choice::Share& one : shares)
    if (one.law == law) return one.share;
  return 0;
}

struct Judging {
  const Process& process;
  const Effects& effects;
  const ProcessOptions& options;
};

LawThere law_there(const ModelFit& fit, const Judging& j, std::vector<double>& tau) {
  LawThere law;
  law.law = fit.model.law->name;
  law.candidate = !fit.reference;
  tau = stress_of(fit.delivered().model, j.process.history, j.process.used);
  double all = 0;
  for (std::size_t row = 0; row < tau.size(); ++row) {
    const double w = j.process.work_J[row];
    law.tau_MPa += w * tau[row];
    law.differs_MPa += w * std::abs(tau[row] - j.process.used.tau_MPa[row]);
    all += w;
  }
  law.tau_MPa /= all;
  law.differs_MPa /= all;
  law.late_percent = j.effects.late_percent(tau);
  law.end_percent = j.effects.end_percent(tau);
  law.force_kN = j.effects.force_kN(tau);
  return law;
}

// Laws that lead: not ruled out, best in some resamples and, where tests lie near the process, not
// worse there than the best by more than a quarter.
void find_leading(Assessment& v, const calibrate::Calibration& calibration, bool has_near) {
  double least = HUGE_VAL;
  for (const LawThere& law : v.laws)
    if (law.candidate) least = std::min(least, law.near_error);
  const auto is_near = [&](const LawThere& law) {
    return !has_near || law.near_error <= near_slack * least;
  };
  const bool chosen = calibration.choice.draws > 0;
  for (LawThere& law : v.laws)
    law.leads =
        law.candidate && is_near(law) && (chosen ? law.best_in >= best_share : law.may_be_best);
  if (std::ranges::none_of(v.laws, [](const LawThere& law) { return law.leads; }))
    for (LawThere& law : v.laws)
      law.leads = law.candidate && is_near(law) && (!has_near || law.near_error <= least);
}

void set_ranges(Assessment& v) {
  v.low_percent = v.all_low_percent = HUGE_VAL;
  v.high_percent = v.all_high_percent = -HUGE_VAL;
  for (const LawThere& law : v.laws) {
    if (law.leads) {
      v.low_percent = std::min(v.low_percent, law.late_percent);
      v.high_percent = std::max(v.high_percent, law.late_percent);
    }
    if (law.leads || law.may_be_best) {
      v.all_low_percent = std::min(v.all_low_percent, law.late_percent);
      v.all_high_percent = std::max(v.all_high_percent, law.late_percent);
    }
  }
}

double difference_of(const std::vector<std::vector<double>>& tau, std::span<const double> work) {
  if (tau.empty()) return 0;
  const double n = static_cast<double>(tau.size());
  double square = 0, all = 0;
  for (std::size_t row = 0; row < work.size(); ++row) {
    double mean = 0, of_row = 0;
    for (const auto& law : tau)
      mean += law[row] / n;
    for (const auto& law : tau)
      of_row += (law[row] - mean) * (law[row] - mean) / n;
    square += work[row] * of_row;
    all += work[row];
  }
  return std::sqrt(square / all);
}

// The recommended law where it leads, else the leading one that ranks first.
std::string law_to_take(const Assessment& v, const calibrate::Calibration& calibration) {
  const std::string& recommended = calibrate::recommended_fit(calibration).model.law->name;
  std::string first;
  for (const LawThere& law : v.laws) {
    if (!law.leads) continue;
    if (law.law == recommended) return recommended;
    if (first.empty()) first = law.law;
  }
  return first.empty() ? recommended : first;
}

std::optional<ParameterThere> parameter_that_matters(const ModelFit& fit, double late_percent,
                                                     const Judging& j) {
  const ModelFit& own = fit.delivered();
  if (models::is_trained(own.model.law->calibrated)) return {};
  ParameterThere most{own.model.law->name, "", 0};
  for (std::size_t i = 0; i < own.model.parameters.size() && i < own.std_error.size(); ++i) {
    if (!(own.std_error[i] > 0)) continue;
    models::Model moved = own.model;
    moved.parameters[i] += own.std_error[i];
    const double change =
        j.effects.late_percent(stress_of(moved, j.process.history, j.process.used)) - late_percent;
    if (std::abs(change) > std::abs(most.percent))
      most = {own.model.law->name, own.model.law->parameters[i].name, change};
  }
  if (most.parameter.empty()) return {};
  return most;
}

Assessment assessment_of(const Tests& tests, const Coverage& coverage, const Judging& j) {
  const calibrate::Calibration& calibration = tests.calibration;
  const Process& p = j.process;
  Assessment v;
  v.tests = tests.all.experiments.size();
  v.thin = coverage.thin.work;
  const bool has_near = v.thin < 0.5;
  const std::vector<std::string> possible = calibrate::possibly_best(calibration.comparisons);
  const NearRows near = near_process(p.history, p.work_J, coverage, tests.all);
  std::vector<std::vector<double>> tau;
  for (const ModelFit& fit : calibration.fits) {
    LawThere law = law_there(fit, j, tau.emplace_back());
    law.may_be_best = std::ranges::find(possible, law.law) != possible.end() ||
                      (possible.empty() && law.candidate);
    law.best_in = share_of(calibration.choice.best_in, law.law);
    law.near_error = near_error(near, calibrate::predict(fit.delivered().model, tests.all),
                                tests.all.values("tau_R_MPa"));
    v.laws.push_back(std::move(law));
  }
  find_leading(v, calibration, has_near);
  set_ranges(v);
  std::vector<std::vector<double>> leading;
  std::vector<std::string> names;
  for (std::size_t l = 0; l < v.laws.size(); ++l) {
    if (v.laws[l].leads) leading.push_back(tau[l]);
    if (v.laws[l].candidate && (v.laws[l].leads || v.laws[l].may_be_best))
      names.push_back(v.laws[l].law);
  }
  v.differ_MPa = difference_of(leading, p.work_J);
  v.take = law_to_take(v, calibration);
  v.resampled = resample_tests(tests, names, p.history, p.used, j.effects, j.options.resamples);
  v.parameter = parameter_that_matters(*calibrate::find_fit(calibration, v.take),
                                       v.law_to_take().late_percent, j);
  return v;
}

// Finds the change of results if a held state were at either end of the tests' values.
void price_held(Process& p, const Tests& tests, const ProcessOptions& options) {
  std::vector<const ModelFit*> leading;
  for (const LawThere& law : p.assessment.laws)
    if (law.leads) leading.push_back(calibrate::find_fit(tests.calibration, law.law));
  for (Held& held : p.history.held) {
    if (!(held.high > held.low)) continue;
    std::vector<std::vector<double>> percent(2);
    ContactHistory moved = p.history;
    for (int end = 0; end < 2; ++end) {
      for (data::Column& column : moved.states.columns)
        if (column.name == held.state)
          column.values.assign(moved.rows(), end == 0 ? held.low : held.high);
      const UsedLaw used = p.history.tau_MPa.empty()
                               ? used_law(moved, options.used, tests.calibration,
                                          tests.calibration.fits.front().model.conventions)
                               : p.used;
      const Effects effects(moved, used, p.prediction == Prediction::force);
      for (const ModelFit* fit : leading)
        percent[static_cast<std::size_t>(end)].push_back(
            effects.late_percent(stress_of(fit->delivered().model, moved, used)));
    }
    for (std::size_t l = 0; l < leading.size(); ++l)
      held.cost_percent = std::max(held.cost_percent, std::abs(percent[1][l] - percent[0][l]));
  }
}

void add_cautions(Process& p) {
  if (p.used.solver_over_law > 0 && p.used.solver_over_law < 0.5)
    p.cautions.push_back(
        fmt::format("the solver's shear stress is {:.2f} of {}'s in the middle of the friction "
                    "work: much of the contact sticks, or it had another law",
                    p.used.solver_over_law, p.used.name));
  if (!p.work_check_percent)
    p.cautions.emplace_back("the friction work could not be compared with the solver's own: "
                            "friction_J in the tool's file shows a wrong symmetry or unit");
}

} // namespace

const LawThere& Assessment::law_to_take() const {
  return *std::ranges::find(laws, take, &LawThere::law);
}

Process judge_process(const Tests& tests, const Tests* added, const ProcessOptions& options,
                      const models::Conventions& conventions) {
  Process p;
  p.history = read_contact(options);
  hold_inputs(p.history, tests, conventions);
  const Driving driving = driving_of(p.history, options);
  p.prediction = driving.prediction;
  p.driven_was_found = driving.found;
  p.used = used_law(p.history, options.used, tests.calibration, conventions);
  p.work_J = p.history.work_J(p.used.tau_MPa);
  check_work(p, options);
  p.coverage = coverage_of(p.history, p.work_J, tests.all);
  const Effects effects(p.history, p.used, p.prediction == Prediction::force);
  const Judging judging{p, effects, options};
  p.assessment = assessment_of(tests, p.coverage, judging);
  price_held(p, tests, options);
  p.proposed = propose_tests(tests, p.history, p.work_J, options);
  p.assessment.open = p.proposed.open;
  if (added) {
    p.with_added = assessment_of(*added, coverage_of(p.history, p.work_J, added->all), judging);
    p.with_added->open = open_ln_tau(*added, p.history, p.work_J, options);
  }
  p.synthetic = calibrate::is_synthetic(tests.training);
  add_cautions(p);
  return p;
}

} // namespace frictab::process
