// States, bystanders and noise of the synthetic campaign.
#include "twin/twin_draft.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "data/quantity.h"

namespace frictab {

namespace {

// What each random stream of an experiment is for; 0 draws the test itself.
constexpr unsigned noise_stream = 1;
constexpr unsigned bystander_stream = 2;
constexpr unsigned humidity_stream = 3;

Column& add_column(Dataset& data, const char* name, std::size_t rows) {
  const Quantity* quantity = find_quantity(name);
  data.columns.push_back({name, quantity ? quantity->unit : "", std::vector<double>(rows), {}});
  return data.columns.back();
}

void fill_states(const TwinParameters& set, TwinDraft& draft, std::size_t points) {
  static constexpr double TwinRow::*members[] = {
      &TwinRow::time_s,      &TwinRow::sigma_n_MPa, &TwinRow::psi,  &TwinRow::v_rel_mm_s,
      &TwinRow::T_contact_C, &TwinRow::T_tool_C,    &TwinRow::s_mm, &TwinRow::sigma_f_MPa};
  static constexpr const char* names[] = {"time_s",      "sigma_n_MPa", "psi",  "v_rel_mm_s",
                                          "T_contact_C", "T_tool_C",    "s_mm", "sigma_f_MPa"};
  const std::size_t rows = draft.plan.size() * points;
  for (const char* name : names)
    add_column(draft.data, name, rows);
  draft.tau0.resize(rows);
  draft.limit.resize(rows);
  parallel_for(draft.plan.size(), [&](std::size_t e) {
    for (std::size_t i = 0; i < points; ++i) {
      const TwinRow row = twin_row(set, draft.plan[e].test, i, points);
      const std::size_t at = e * points + i;
      for (std::size_t c = 0; c < std::size(members); ++c)
        draft.data.columns[c].values[at] = row.*members[c];
      draft.tau0[at] = row.tau0_MPa;
      draft.limit[at] = row.limit_MPa;
    }
  });
  add_column(draft.data, "tau_R_MPa", rows);
}

// Student's t with 4 degrees of freedom, scaled to standard deviation 1.
double heavy_tailed(Random& random) {
  double chi = 0;
  const double top = random.normal();
  for (int i = 0; i < 4; ++i)
    chi += std::pow(random.normal(), 2);
  return top / std::sqrt(chi / 4) / std::sqrt(2.0);
}

// One hidden factor per test (coating weight, residue on the tool), AR(1) and white noise.
void fill_noise(const TwinOptions& options, const TwinParameters& set, TwinDraft& draft,
                std::size_t points) {
  draft.noise.resize(draft.plan.size() * points);
  const bool heavy = options.noise == "t4";
  const TwinNoise level = noise_of(options, set);
  parallel_for(draft.plan.size(), [&](std::size_t e) {
    Random random(options.seed, twin_stream(draft.part, e, noise_stream));
    const auto draw = [&] { return heavy ? heavy_tailed(random) : random.normal(); };
    double scale = options.noise_scale;
    if (options.noise == "heteroscedastic")
      scale *= std::clamp(std::pow(draft.plan[e].test.v / 50, 0.3), 0.25, 2.5);
    const double factor = std::exp(scale * level.test * draw());
    const double step = std::sqrt(1 - level.rho * level.rho);
    double slow = random.normal();
    for (std::size_t i = 0; i < points; ++i) {
      if (i > 0) slow = level.rho * slow + step * random.normal();
      const double white = draw();
      // Exponentials of small numbers: 1 + noise that cannot turn negative.
      draft.noise[e * points + i] =
          factor * std::exp(scale * level.slow * slow) * std::exp(scale * level.white * white);
    }
  });
}

// Room climate follows the order of tests: an AR(1) over both parts.
std::vector<double> humidity_by_order(std::uint64_t seed, std::size_t tests) {
  Random random(seed, twin_stream(2, 0, humidity_stream));
  std::vector<double> humidity(tests);
  double state = random.normal();
  for (double& value : humidity) {
    value = round_to(std::clamp(45 + 8 * state, 5.0, 95.0), 1);
    state = 0.9 * state + std::sqrt(1 - 0.81) * random.normal();
  }
  return humidity;
}

void fill_constant(Column& column, std::size_t experiment, std::size_t points, double value) {
  std::fill_n(column.values.begin() + static_cast<std::ptrdiff_t>(experiment * points), points,
              value);
}

void fill_bystanders(std::uint64_t seed, std::size_t tests, TwinDraft& draft, std::size_t points) {
  const std::size_t rows = draft.plan.size() * points;
  const std::size_t first = draft.data.columns.size();
  for (const char* name : {"run_order", "humidity_pct", "film_um", "Ra_um", "tool"})
    add_column(draft.data, name, rows);
  draft.data.columns.back().levels = {"A", "B", "C"};
  const auto humidity = humidity_by_order(seed, tests);
  for (std::size_t e = 0; e < draft.plan.size(); ++e) {
    Random random(seed, twin_stream(draft.part, e, bystander_stream));
    const std::size_t order = draft.plan[e].run_order;
    const double film = round_to(8 * std::exp(0.15 * random.normal()), 2);
    const double roughness = round_to(0.35 * std::exp(0.25 * random.normal()), 3);
    const double values[] = {static_cast<double>(order), humidity[order - 1], film, roughness,
                             static_cast<double>(random.below(3))};
    for (std::size_t c = 0; c < std::size(values); ++c)
      fill_constant(draft.data.columns[first + c], e, points, values[c]);
  }
}

} // namespace

TwinDraft draft_part(const TwinOptions& options, const TwinParameters& set, const TwinPlan& plan,
                     unsigned part) {
  TwinDraft draft;
  draft.part = part;
  draft.plan = part == 0 ? plan.training : plan.validation;
  const std::size_t points = options.design->points;
  for (const TwinExperiment& experiment : draft.plan) {
    draft.data.experiments.push_back(experiment.name);
    draft.data.first_row.push_back(draft.data.first_row.back() + points);
  }
  fill_states(set, draft, points);
  fill_noise(options, set, draft, points);
  fill_bystanders(options.seed, plan.training.size() + plan.validation.size(), draft, points);
  return draft;
}

const Column* find_column(const Dataset& data, std::string_view name) {
  const auto at = std::find_if(data.columns.begin(), data.columns.end(),
                               [&](const Column& column) { return column.name == name; });
  return at == data.columns.end() ? nullptr : &*at;
}

Column* find_column(Dataset& data, std::string_view name) {
  return const_cast<Column*>(find_column(static_cast<const Dataset&>(data), name));
}

} // namespace frictab
