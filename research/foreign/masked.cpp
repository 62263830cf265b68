// Masked designs: several 0/1 columns that each multiply friction, so that each hides the others.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "foreign/part.h"
#include "trace_results.h"

namespace frictab::foreign {

namespace {

// Half of the tests each, in random order.
Values halves(std::size_t tests, Random& random) {
  Values values(tests);
  for (std::size_t e = 0; e < tests; ++e)
    values[e] = static_cast<double>(e % 2);
  random.shuffle(std::span<double>(values));
  return values;
}

// Not so alike that nobody could tell them apart.
std::vector<Values> distinguishable_errors(std::size_t columns, std::size_t tests, Random& random) {
  std::vector<Values> all;
  while (all.size() < columns) {
    const Values next = halves(tests, random);
    if (std::all_of(all.begin(), all.end(), [&](const Values& other) {
          return std::abs(bench::correlation(next, other)) < 0.5;
        }))
      all.push_back(next);
  }
  return all;
}

void add_six(Part& part, Random& random) {
  for (int b = 1; b <= 6; ++b) {
    Values values;
    for (std::size_t e = 0; e < part.tests(); ++e)
      values.push_back(b <= 3   ? random.normal()
                       : b <= 5 ? static_cast<double>(random.below(2))
                                : static_cast<double>(e < 3 ? e : random.below(3)));
    random.shuffle(std::span<double>(values));
    const std::string name = fmt::format("by_{}", b);
    if (b == 6)
      part.add_per_test(name, values, {"k", "l", "m"});
    else
      part.add_per_test(name, values);
  }
}

Part masked_part(const Options& options, std::size_t tests, const Program& program,
                 Random& random) {
  Part part;
  for (std::size_t e = 0; e < tests; ++e)
    simulate(part, program, {random.uniform(), random.uniform(), 0.5, 0.5},
             rows_of_a_test(options.rows, random), random);
  // Forming or a plain rig; no flow stress, so that nothing limits friction.
  const bool plain = options.seed % 2 == 0;
  std::erase_if(part.columns, [&](const data::Column& c) {
    return c.name == "sigma_f_MPa" || (plain && (c.name == "psi" || c.name == "T_contact_C"));
  });
  const auto columns = distinguishable_errors(options.masked_columns, tests, random);
  part.law = part.at("sigma_n_MPa");
  for (std::size_t c = 0; c < columns.size(); ++c) {
    part.add_per_test(fmt::format("x{}", c + 1), columns[c]);
    const Values on = part.spread(columns[c]);
    for (std::size_t i = 0; i < on.size(); ++i)
      part.law[i] *= on[i] > 0 ? options.masked_factor : 1;
  }
  for (double& x : part.law)
    x *= 0.03;
  part.truth = part.law;
  add_six(part, random);
  return part;
}

Noise three_percent(const Part& part, Random& random) {
  Noise noise{Values(part.rows()), {}, 0.03};
  for (std::size_t e = 0; e < part.tests(); ++e) {
    const double gain = 1 + 0.03 * random.normal();
    noise.gains.push_back(gain);
    for (std::size_t i = part.first_row[e]; i < part.first_row[e + 1]; ++i)
      noise.factor[i] = gain * (1 + 0.01 * random.normal());
  }
  return noise;
}

} // namespace

Draft masked_draft(const Options& options, Random& random) {
  Draft draft;
  const Program program = draw_program("", random);
  draft.parts.training = masked_part(options, options.tests, program, random);
  draft.parts.validation = masked_part(options, 60, program, random);
  draft.training = three_percent(draft.parts.training, random);
  draft.validation = three_percent(draft.parts.validation, random);
  draft.base = "coulomb";
  for (std::size_t c = 0; c < options.masked_columns; ++c) {
    const std::string name = fmt::format("x{}", c + 1);
    draft.causes.push_back({name, {{name}}});
  }
  return draft;
}

} // namespace frictab::foreign
