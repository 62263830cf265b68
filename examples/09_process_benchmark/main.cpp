// Forming processes with the friction of a law: the command line.
#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "checks.h"
#include "options.h"

namespace {

void print(const Setup& setup, const Result& result) {
  const StepRecord& end = result.last();
  double friction = 0, imbalance = 0;
  for (const StepRecord& step : result.steps) {
    friction = std::max(friction, step.friction_error);
    imbalance = std::max(imbalance, step.imbalance);
  }
  const double spent = end.energies.plastic + end.energies.friction + end.energies.elastic;
  std::printf("%s, %s\n", setup.process.c_str(), setup.law.c_str());
  std::printf("  stroke %.4g mm, force %.3f kN\n", end.stroke, end.force);
  if (setup.process == "ring")
    std::printf("  inner radius: %.4f mm at mid height, %.4f at the platen, %.4f mean\n",
                end.inner_mid, end.inner_top, end.inner_mean);
  if (setup.process != "rod")
    std::printf("  outer radius: %.4f mm at mid height, %.4f at the platen\n", end.outer_mid,
                end.outer_top);
  std::printf("  contact: %.1f degC, %.0f MPa on average; %.1f %% of the area outside the law's "
              "range\n",
              end.mean_temperature, end.mean_pressure, 100 * end.outside);
  std::printf("  work %.3f J = plastic %.3f + friction %.3f + elastic %.3f J (%+.3f %%); volume "
              "%+.3f %%\n",
              end.work / 1e3, end.energies.plastic / 1e3, end.energies.friction / 1e3,
              end.energies.elastic / 1e3, 100 * (spent / end.work - 1),
              100 * (end.volume / result.first_volume - 1));
  std::printf("  |tau - tau_R factors| <= %.1e MPa at %zu contact points; forces balance to %.1e\n",
              friction, result.sliding_points, imbalance);
}

} // namespace

int main(int count, char** words) {
  try {
    const Command command = read_command(count, words);
    if (command.help) {
      std::fputs(usage().c_str(), stdout);
      return 0;
    }
    if (command.setup.process == "check") return checks(command) ? 0 : 1;
    const Result result = run_process(command.setup);
    print(command.setup, result);
    if (!command.output.empty())
      write_result(result, command.output, static_cast<std::size_t>(command.every));
    return 0;
  } catch (const std::invalid_argument& fault) {
    std::fprintf(stderr, "process_benchmark: %s\n  hint: process_benchmark --help\n", fault.what());
    return 2;
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "process_benchmark: %s\n", fault.what());
    return 3;
  }
}
