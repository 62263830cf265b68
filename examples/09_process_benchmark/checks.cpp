#include "checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "reference.h"

namespace {

// Prints each comparison and remembers whether one has failed.
class Report {
public:
  void within(const char* claim, double value, double expected, double share) {
    const double off = value / expected - 1;
    say(std::abs(off) <= share, claim);
    std::printf("%.4f against %.4f: %+.3f %% (allowed %.3g %%)\n", value, expected, 100 * off,
                100 * share);
  }
  void at_most(const char* claim, double value, double limit) {
    say(value <= limit, claim);
    std::printf("%.3g (allowed %.3g)\n", value, limit);
  }
  void falls(const char* claim, double before, double after) {
    say(after < before, claim);
    std::printf("%.4f, then %.4f\n", before, after);
  }
  bool right = true;

private:
  void say(bool ok, const char* claim) {
    right = right && ok; // NaN is not ok
    std::printf("%-6s %s: ", ok ? "ok" : "FAILED", claim);
  }
};

Result ring(const std::string& law, std::size_t columns = 8, std::size_t rows = 4) {
  Setup setup = default_setup("ring");
  setup.law = law;
  setup.columns = columns;
  setup.rows = rows;
  return run_process(setup);
}

// What every process must fulfil, whatever its law.
void balances(Report& report, const Result& result) {
  double friction = 0, imbalance = 0, volume = 0;
  for (const StepRecord& step : result.steps) {
    friction = std::max(friction, step.friction_error);
    imbalance = std::max(imbalance, step.imbalance);
    volume = std::max(volume, std::abs(step.volume / result.first_volume - 1));
  }
  const StepRecord& end = result.last();
  report.within("  plastic + friction + elastic = work of the force, J",
                (end.energies.plastic + end.energies.friction + end.energies.elastic) / 1e3,
                end.work / 1e3, 0.01);
  report.at_most("  largest change of volume, share", volume, 0.003);
  report.at_most("  force of the die against force of the support, share", imbalance, 1e-6);
  std::printf("       %zu states of contact points\n", result.sliding_points);
  report.at_most("  |tau - tau_R factors|, MPa", friction, 1e-9);
}

void no_friction(Report& report, RingSize start) {
  const Setup setup = default_setup("ring");
  const Result result = ring("none");
  std::puts("no friction, against the exact rigid-plastic ring");
  report.within("force, kN", result.last().force,
                frictionless_force(start, setup.reduction, setup.material), 0.005);
  report.within("inner radius, mm", result.last().inner_mid,
                frictionless_ring(start, setup.reduction).inner_radius, 0.005);
  balances(report, result);
}

void shear(Report& report, RingSize start) {
  double before = frictionless_ring(start, 0.5).inner_radius;
  for (const double m : {0.1, 0.2, 0.5, 1.0}) {
    char law[32];
    std::snprintf(law, sizeof law, "shear:%g", m);
    const Result result = ring(law);
    std::printf("shear friction, m = %g\n", m);
    if (m <= 0.2)
      report.within("mean inner radius against Avitzur's upper bound, mm", result.last().inner_mean,
                    avitzur_ring(start, 0.5, m).inner_radius, 0.03);
    report.falls("inner radius at mid height falls with m, mm", before, result.last().inner_mid);
    before = result.last().inner_mid;
    balances(report, result);
  }
}

void coulomb(Report& report, const Command& command) {
  const double mu = command.ccx_mu > 0 ? command.ccx_mu : 0.065;
  const std::string law = "coulomb:" + std::to_string(mu);
  const Result coarse = ring(law, 8, 4), fine = ring(law, 12, 6);
  std::printf("Coulomb friction, mu = %g\n", mu);
  report.within("two meshes: force, kN", coarse.last().force, fine.last().force, 0.005);
  report.within("two meshes: inner radius, mm", coarse.last().inner_mid, fine.last().inner_mid,
                0.005);
  balances(report, fine);
  if (command.ccx_force > 0) {
    report.within("force against CalculiX, kN", fine.last().force, command.ccx_force, 0.007);
    report.within("inner radius against CalculiX, mm", fine.last().inner_mid, command.ccx_radius,
                  0.007);
  }
}

// The generated routine, with temperatures, in both kinds of die.
void routine(Report& report, const std::string& law) {
  for (const char* process : {"ring", "rod"}) {
    Setup setup = default_setup(process);
    setup.law = law;
    setup.heat.on = true;
    if (setup.process == "rod") {
      setup.steps = 40;
      setup.stroke = 3;
    } else {
      setup.columns = 8;
      setup.rows = 4;
    }
    const Result result = run_process(setup);
    std::printf("%s with the generated routine and heat: %.3f kN, %.1f degC\n", process,
                result.last().force, result.last().mean_temperature);
    balances(report, result);
  }
}

} // namespace

bool checks(const Command& command) {
  Report report;
  const RingSize start{4.5, 9, 6};
  no_friction(report, start);
  shear(report, start);
  coulomb(report, command);
  if (command.setup.law != "none") routine(report, command.setup.law);
  std::puts(report.right ? "all checks passed" : "A CHECK FAILED");
  return report.right;
}
