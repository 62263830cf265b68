// Drafts states, bystanders and noise of the synthetic campaign.
#include "twin/twin_draft.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "core/random.h"
#include "data/quantity.h"
#include "twin/twin_bystanders.h"

namespace frictab::twin {

namespace {

constexpr unsigned noise_stream = 1; // stream 0 draws the test itself

void fill_states(const TwinParameters& set, TwinDraft& draft, std::size_t points) {
  static constexpr std::pair<const char*, double TwinRow::*> states[] = {
      {"time_s", &TwinRow::time_s},
      {"sigma_n_MPa", &TwinRow::sigma_n_MPa},
      {"psi", &TwinRow::psi},
      {"v_rel_mm_s", &TwinRow::v_rel_mm_s},
      {"T_contact_C", &TwinRow::T_contact_C},
      {"T_tool_C", &TwinRow::T_tool_C},
      {"s_mm", &TwinRow::s_mm},
      {"sigma_f_MPa", &TwinRow::sigma_f_MPa}};
  const std::size_t rows = draft.plan.size() * points;
  for (const auto& [name, member] : states)
    add_column(draft.data, name, rows);
  draft.base = {std::vector<double>(rows), std::vector<double>(rows), std::vector<double>(rows)};
  parallel_for(draft.plan.size(), [&](std::size_t e) {
    for (std::size_t i = 0; i < points; ++i) {
      const TwinRow row = twin_row(set, draft.plan[e].test, i, points);
      const std::size_t at = e * points + i;
      for (std::size_t c = 0; c < std::size(states); ++c)
        draft.data.columns[c].values[at] = row.*states[c].second;
      draft.base.tau0[at] = row.tau0_MPa;
      draft.base.limit[at] = row.limit_MPa;
    }
  });
  add_column(draft.data, "tau_R_MPa", rows);
}

// Draws Student's t with 4 degrees of freedom, scaled to standard deviation 1.
double heavy_tailed(Random& random) {
  double chi = 0;
  const double top = random.normal();
  for (int i = 0; i < 4; ++i)
    chi += std::pow(random.normal(), 2);
  return top / std::sqrt(chi / 4) / std::sqrt(2.0);
}

// Draws one hidden factor per test (coating weight, residue on the tool), AR(1) and white noise.
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
      // For small numbers the exponential is 1 + noise, but it cannot turn negative.
      draft.noise[e * points + i] =
          factor * std::exp(scale * level.slow * slow) * std::exp(scale * level.white * white);
    }
  });
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
  add_bystanders(options, plan.training.size() + plan.validation.size(), draft);
  return draft;
}

std::vector<double> tau_of(const TwinDraft& draft, const TauPieces& pieces) {
  if (draft.law) return draft.law->tau(draft.data, pieces, draft.law->parameters());
  std::vector<double> tau(pieces.tau0.size());
  for (std::size_t i = 0; i < tau.size(); ++i)
    tau[i] = twin_tau(pieces.tau0[i], pieces.limit[i]) + pieces.shift[i];
  return tau;
}

std::vector<double> base_tau(const TwinDraft& draft) {
  return tau_of(draft, draft.base);
}

data::Column& add_column(data::Dataset& data, const char* name, std::size_t rows) {
  const data::Quantity* quantity = data::find_quantity(name);
  data.columns.push_back({name, quantity ? quantity->unit : "", std::vector<double>(rows), {}});
  return data.columns.back();
}

std::vector<double>& measured_of(data::Dataset& data) {
  return std::ranges::find(data.columns, "tau_R_MPa", &data::Column::name)->values;
}

} // namespace frictab::twin
