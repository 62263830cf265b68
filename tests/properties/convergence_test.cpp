// Every fitted law finds the best fit there is, on campaigns of very different shapes.
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "calibrate/calibration.h"
#include "calibrate/law_problem.h"
#include "calibrate/normal_equations.h"
#include "core/random.h"
#include "support/sample_data.h"

namespace frictab::convergence_test {

using calibrate::Loss;
using data::Dataset;
using models::Model;

namespace {

void scale(Dataset& data, const std::string& name, const std::function<double(double)>& change) {
  for (data::Column& column : data.columns)
    if (column.name == name)
      for (double& x : column.values)
        x = change(x);
}

// tau_R again from the model, after the states have been changed.
Dataset measured_again(Dataset data, const Model& truth, double scatter, double noise_MPa) {
  std::vector<double> tau = calibrate::predict(truth, data);
  Random random(17);
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const double factor = std::exp(scatter * random.normal());
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
      tau[i] = std::max(0.0, tau[i] * factor + noise_MPa * random.normal());
  }
  test::column(data, "tau_R_MPa").values = tau;
  return data;
}

struct Shape {
  std::string name;
  Dataset (*make)(const Model& truth);
};

// One experiment has 40 times the rows of each other.
Dataset dominated(const Model& truth) {
  test::SampleOptions options;
  options.experiments = 1;
  options.rows = 800;
  Dataset data = test::sample_data(truth, options);
  options.experiments = 10;
  options.rows = 20;
  options.seed = 2;
  const Dataset others = test::sample_data(truth, options);
  for (std::size_t c = 0; c < data.columns.size(); ++c)
    data.columns[c].values.insert(data.columns[c].values.end(), others.columns[c].values.begin(),
                                  others.columns[c].values.end());
  for (std::size_t e = 0; e < 10; ++e) {
    data.experiments.push_back("other " + std::to_string(e));
    data.first_row.push_back(data.first_row.back() + 20);
  }
  return measured_again(data, truth, 0.1, 5);
}

const std::vector<Shape> shapes = {
    {"wide",
     [](const Model& truth) {
       return measured_again(test::sample_data(truth, {.experiments = 30, .rows = 50}), truth, 0.05,
                             5);
     }},
    {"narrow stress",
     [](const Model& truth) {
       Dataset data = test::sample_data(truth, {.experiments = 20, .rows = 40});
       scale(data, "sigma_n_MPa", [](double s) { return 1500 + 0.05 * (s - 1500); });
       return measured_again(data, truth, 0.05, 5);
     }},
    {"few experiments",
     [](const Model& truth) {
       return measured_again(test::sample_data(truth, {.experiments = 3, .rows = 30}), truth, 0.1,
                             3);
     }},
    {"one experiment dominates", dominated},
    {"very noisy",
     [](const Model& truth) {
       return measured_again(test::sample_data(truth, {.experiments = 20, .rows = 40}), truth, 0.4,
                             40);
     }},
    {"low stress",
     [](const Model& truth) { // sheet forming: 1/200 of the contact normal stress
       Dataset data = test::sample_data(truth, {.experiments = 20, .rows = 40});
       scale(data, "sigma_n_MPa", [](double s) { return s / 200; });
       return measured_again(data, truth, 0.05, 0.02);
     }},
    {"high stress",
     [](const Model& truth) {
       Dataset data = test::sample_data(truth, {.experiments = 20, .rows = 40});
       scale(data, "sigma_n_MPa", [](double s) { return s * 4; });
       return measured_again(data, truth, 0.05, 5);
     }},
    {"hot and fast",
     [](const Model& truth) {
       Dataset data = test::sample_data(truth, {.experiments = 20, .rows = 40});
       scale(data, "T_contact_C", [](double t) { return t * 5; });
       scale(data, "v_rel_mm_s", [](double v) { return v * 20; });
       return measured_again(data, truth, 0.05, 5);
     }},
};

class SlowConvergence : public testing::TestWithParam<std::string> {};

// The least loss of 50 starts spread over the bounds, each polished on all rows. L1 is polished
// with a rounding that is small to `scatter`, and then taken without.
double best_of_many(const calibrate::FitProblem& problem, Loss kind, double scatter) {
  double best = std::numeric_limits<double>::infinity();
  std::vector<double> unit(problem.parameters.size());
  for (std::size_t i = 0; i < 50; ++i) {
    halton(100 + i, unit);
    std::vector<double> start;
    for (std::size_t p = 0; p < unit.size(); ++p) {
      const models::Parameter& b = problem.parameters[p];
      start.push_back(calibrate::is_scale(b) ? b.lower * std::pow(b.upper / b.lower, unit[p])
                                             : b.lower + unit[p] * (b.upper - b.lower));
    }
    calibrate::FitResult fit = calibrate::fit_from(problem, {Loss::l2, 0}, start);
    if (kind == Loss::huber) fit = calibrate::fit_from(problem, {kind, 10}, fit.parameters);
    if (kind == Loss::l1)
      for (const double share : {0.1, 0.01, 0.001})
        fit = calibrate::fit_from(problem, {kind, share * scatter, 6 * share * scatter},
                                  fit.parameters);
    best = std::min(
        best, calibrate::mean_cost(problem, {kind, kind == Loss::l1 ? 0.0 : 10}, fit.parameters));
  }
  return best;
}

TEST_P(SlowConvergence, NoneOf50StartsFindsABetterFit) {
  const Model truth = test::plausible_model(*models::find_law(GetParam()));
  const models::Law& law = *truth.law;
  const auto names = models::inputs(law, {});
  const expr::Program program(models::tau_formula(law, {}), names, models::parameter_names(law));
  for (const Shape& shape : shapes) {
    const Dataset data = shape.make(truth);
    std::vector<const double*> columns;
    for (const std::string& name : names)
      columns.push_back(data.values(name).data());
    const expr::BoundProgram bound(program, data.rows(), columns);
    const calibrate::FitProblem problem{bound, data.values("tau_R_MPa"), law.parameters};
    for (const Loss kind : {Loss::l2, Loss::l1, Loss::huber}) {
      const calibrate::LawFit fit = calibrate::LawProblem(law, {}, data).fit(kind, 10);
      const calibrate::LossFunction loss{kind, kind == Loss::l1 ? 0.0 : 10};
      const double found = calibrate::mean_cost(problem, loss, fit.result.parameters);
      const double best = best_of_many(problem, kind, found);
      EXPECT_LE(found, best * (1 + 1e-6))
          << shape.name << ", loss " << static_cast<int>(kind) << ": " << fit.result.termination
          << ", " << found / best - 1;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, SlowConvergence, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const models::Law& law : models::all_laws())
                             if (law.calibrated == models::Calibrated::fit)
                               names.push_back(law.name);
                           return names;
                         }()),
                         [](const auto& test) { return test.param; });

} // namespace
} // namespace frictab::convergence_test
