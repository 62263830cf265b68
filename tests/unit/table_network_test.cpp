// Tables of a law that bends in all its states: where nodes lie, and how few a spline needs.
#include <gtest/gtest.h>

#include "core/random.h"
#include "models/neural_network.h"
#include "table/drift.h"

namespace frictab {
namespace {

// An ensemble that bends in all five states, as trained ones do, with random weights.
Model network_model() {
  Network network;
  network.inputs = {{"sigma_n_MPa", false, 0, 0, 1600, 600},
                    {"psi", true, 1, 0, 1.5, 0.9},
                    {"v_rel_mm_s", true, 0.1, 1, 4, 1.2},
                    {"T_contact_C", false, 0, 0, 110, 50},
                    {"s_mm", true, 0, 0.5, 1.5, 1.3}};
  network.hidden = 4;
  Random random(12);
  for (int m = 0; m < 3; ++m) {
    network.members.emplace_back();
    for (std::size_t w = 0; w < Network::weights(5, network.hidden); ++w)
      network.members.back().push_back(0.2 * random.normal());
  }
  Model model;
  model.law = made(neural_network(network));
  model.parameters = {0.08};
  return model;
}

TEST(Table, OfALawThatBendsInFiveStatesIsSmallWhereItIsCubic) {
  const Model model = network_model();
  std::vector<StateRange> ranges = {
      {"sigma_n_MPa", 500, 2750, ""}, {"psi", 1, 20, ""},  {"v_rel_mm_s", 5, 500, ""},
      {"T_contact_C", 20, 200, ""},   {"s_mm", 0, 40, ""}, {"sigma_f_MPa", 250, 1200, ""}};
  std::size_t nodes[2];
  for (const bool cubic : {false, true}) {
    TableOptions options;
    options.tolerance_MPa = 1;
    options.interpolation = cubic ? "cubic" : "linear";
    const Table table = build_table(model, ranges, options);
    const TableFunction function(table);
    EXPECT_LE(worst_case(LawFunction(model, function.inputs()), function, ranges,
                         probe_points(ranges, table.axes, 50000))
                  .drift_MPa,
              1.0);
    nodes[cubic] = table.nodes();
  }
  EXPECT_LT(nodes[1], 10000U);
  EXPECT_LT(5 * nodes[1], nodes[0]);
}

TEST(Table, NodesLieWhereTheLawBends) {
  TableOptions options; // ln(s + 0.5): bends near zero, on an axis that cannot be logarithmic
  const Model model = network_model();
  const std::vector<StateRange> ranges = {
      {"sigma_n_MPa", 1000, 1001, ""}, {"psi", 2, 2.01, ""}, {"v_rel_mm_s", 50, 51, ""},
      {"T_contact_C", 99, 100, ""},    {"s_mm", 0, 40, ""},  {"sigma_f_MPa", 500, 501, ""}};
  options.tolerance_MPa = 0.02;
  const Table graded = build_table(model, ranges, options);
  options.axes["s_mm"].spacing = "linear";
  const Table even = build_table(model, ranges, options);
  EXPECT_LT(2 * graded.axes[4].nodes.size(), even.axes[4].nodes.size());
  EXPECT_GT(even.axes[4].per_step(), 0);
  EXPECT_LT(4 * (graded.axes[4].nodes[1] - graded.axes[4].nodes[0]),
            graded.axes[4].nodes.back() - *(graded.axes[4].nodes.end() - 2));
}

} // namespace
} // namespace frictab
