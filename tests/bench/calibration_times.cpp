// Times the fit of every calibrated law on a synthetic campaign.
//
// usage: calibration_times FILE.csv [ROUNDS]
// Writes the 44,550 rows to FILE.csv and prints, per law and loss, the best wall times in ms on one
// thread of preparing (logarithms and thinned copies of the columns), fit and standard errors, then
// the parameters; and the time of all that for all laws at once on all cores.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>

#include "calibrate/law_problem.h"
#include "core/parallel.h"
#include "data/write_dataset.h"
#include "twin/twin.h"

namespace frictab {

using calibrate::Loss;

namespace {

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

void time_law(const models::Law& law, const data::Dataset& data, Loss loss, int rounds) {
  const models::Conventions conventions;
  double prepare_ms = 1e9, fit_ms = 1e9, errors_ms = 1e9;
  calibrate::LawFit fit;
  for (int i = 0; i < rounds; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    const calibrate::LawProblem problem(law, conventions, data);
    const auto prepared = std::chrono::steady_clock::now();
    prepare_ms = std::min(prepare_ms, milliseconds_since(begin));
    fit = problem.fit(loss, 10);
    fit_ms = std::min(fit_ms, milliseconds_since(prepared));
    const auto fitted = std::chrono::steady_clock::now();
    problem.add_uncertainty(fit, loss, 10, data);
    errors_ms = std::min(errors_ms, milliseconds_since(fitted));
  }
  std::printf("%s %s %.3f %.3f %.3f", law.name.c_str(), loss == Loss::l2 ? "L2" : "L1", prepare_ms,
              fit_ms, errors_ms);
  for (const double p : fit.result.parameters)
    std::printf(" %.17g", p);
  std::printf("\n");
}

// All laws at once on all cores, as the calibration stage does.
void time_all(const data::Dataset& data, Loss loss, int rounds) {
  std::vector<const models::Law*> laws;
  for (const models::Law& law : models::all_laws())
    if (law.calibrated == models::Calibrated::fit) laws.push_back(&law);
  double ms = 1e9;
  for (int i = 0; i < rounds; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    parallel_for(laws.size(), [&](std::size_t l) {
      const calibrate::LawProblem problem(*laws[l], {}, data);
      calibrate::LawFit fit = problem.fit(loss, 10);
      problem.add_uncertainty(fit, loss, 10, data);
    });
    ms = std::min(ms, milliseconds_since(begin));
  }
  std::printf("all %s 0 %.3f 0\n", loss == Loss::l2 ? "L2" : "L1", ms);
}

} // namespace
} // namespace frictab

int main(int argc, char** argv) try {
  using namespace frictab;
  if (argc < 2) return 2;
  const data::Dataset data = twin::make_twin({}).training.data;
  std::ofstream(argv[1]) << data::csv_text(data);
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  for (const calibrate::Loss loss : {calibrate::Loss::l2, calibrate::Loss::l1}) {
    for (const models::Law& law : models::all_laws())
      if (law.calibrated == models::Calibrated::fit) time_law(law, data, loss, rounds);
    time_all(data, loss, rounds);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
