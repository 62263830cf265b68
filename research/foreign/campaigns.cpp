// Puts campaigns together: states, bystanders, friction, effects of a given strength, noise.
#include "foreign/campaigns.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

#include "data/quantity.h"
#include "foreign/part.h"

namespace frictab::foreign {

using data::Column;
using data::Dataset;

namespace {

constexpr std::size_t held_out_tests = 60;
constexpr std::size_t held_out_rows = 300; // of a test, at most

// One stream of random numbers per stage, so that none depends on what another one draws.
enum Stage : std::uint64_t { states = 1, bystanders, friction, effect, noise, record };

Random stage(const Options& options, Stage which) {
  return Random(options.seed, static_cast<std::uint64_t>(which));
}

Part simulated(const Options& options, const Program& program, const std::vector<Point>& points,
               std::size_t most_rows, Random& random) {
  Part part;
  Values tool;
  for (const Point& point : points) {
    const std::size_t rows = rows_of_a_test(options.rows, random);
    simulate(part, program, point, std::min(rows, most_rows), random);
    tool.push_back(20 + 180 * point[2]);
  }
  part.add_per_test("T_tool_C", tool);
  return part;
}

// How much the base law errs beyond the noise, on the held-out tests, with an effect so large.
class Excess {
public:
  Excess(Draft& draft, const Shape& shape)
      : draft_(draft), shapes_{shape(draft.parts.training), shape(draft.parts.validation)} {}

  double with(double amplitude) {
    const Values training = measured(draft_.parts.training, shapes_[0], draft_.training, amplitude);
    const Values unseen =
        measured(draft_.parts.validation, shapes_[1], draft_.validation, amplitude);
    const Values fitted =
        refitted(draft_.base, draft_.parts.training, training, draft_.parts.validation);
    return mean_error(unseen, fitted) / mean_error(unseen, draft_.parts.validation.truth);
  }

private:
  static Values measured(Part& part, const Values& shape, const Noise& noise, double amplitude) {
    part.truth = part.law;
    for (std::size_t i = 0; i < shape.size(); ++i)
      part.truth[i] *= std::exp(std::clamp(amplitude * shape[i], -3.0, 3.0));
    part.truth = limited(part, part.truth);
    Values tau = part.truth;
    for (std::size_t i = 0; i < tau.size(); ++i)
      tau[i] *= noise.factor[i];
    return tau;
  }

  Draft& draft_;
  Values shapes_[2];
};

// Leaves the truth at the amplitude that reaches the strength.
void add_effect(Draft& draft, const Shape& shape, double strength) {
  Excess excess(draft, shape);
  const double target = excess.with(0) + strength;
  double low = 0, high = 0.005;
  while (excess.with(high) < target) {
    low = high;
    high *= 1.6;
    if (high < 8) continue;
    draft.absorbed = true;
    return;
  }
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (excess.with(middle) < target ? low : high) = middle;
  }
  excess.with(high);
}

// Some bystanders are recorded, always those that the effect needs.
std::vector<std::string> not_recorded(const Part& part, const std::vector<Cause>& causes,
                                      Random& random) {
  const std::vector<std::string> states_ = {"time_s", "sigma_n_MPa", "psi",      "v_rel_mm_s",
                                            "s_mm",   "T_contact_C", "T_tool_C", "sigma_f_MPa"};
  std::vector<std::string> hidden;
  for (const Column& column : part.columns) {
    const bool keep = random.uniform() < (column.name == "run_order" ? 0.5 : 0.65);
    bool needed = std::find(states_.begin(), states_.end(), column.name) != states_.end();
    for (const Cause& cause : causes)
      for (const auto& answer : cause.answers)
        needed = needed || std::find(answer.begin(), answer.end(), column.name) != answer.end();
    const bool never = column.name.starts_with("hidden") || column.name.starts_with("oil_C of");
    if (never || !(keep || needed)) hidden.push_back(column.name);
  }
  return hidden;
}

// The oil temperature that follows the batch of this effect is recorded after all.
void record_oil(Draft& draft, const std::string& effect) {
  if (!effect.starts_with("hidden batch") || effect.ends_with("without a trace")) return;
  const bool blocks = effect.ends_with("in blocks");
  for (Part* part : {&draft.parts.training, &draft.parts.validation})
    for (Column& column : part->columns)
      if (column.name == (blocks ? "oil_C of hidden_block" : "oil_C of hidden_batch"))
        column.name = "oil_C";
}

// A mildly wrong base law: it errs by 15 % more than the noise.
void make_unlike(Draft& draft, const Options& options, Random& random) {
  for (Part* part : {&draft.parts.training, &draft.parts.validation})
    part->truth = part->law;
  if (options.truth != "unlike any law") return;
  add_effect(draft, unlike_any_law(draft.parts.training, random), 0.15);
  for (Part* part : {&draft.parts.training, &draft.parts.validation})
    part->law = part->truth;
  draft.absorbed = false; // then it is not wrong, which is no fault of the campaign
}

Draft forging_draft(const Options& options) {
  Random random = stage(options, states), room = stage(options, bystanders),
         tribology = stage(options, friction), cause = stage(options, effect),
         scatter = stage(options, noise), recorder = stage(options, record);
  const Program program = draw_program(options.effect, random);
  const auto points = design(options, random);
  const auto unseen = held_out_points(points, held_out_tests, random);
  Draft draft;
  draft.parts.training = simulated(options, program, points, 100000, random);
  draft.parts.validation = simulated(options, program, unseen, held_out_rows, random);
  add_bystanders(draft.parts, room);
  add_friction(draft.parts, options.truth, tribology);
  draft.base = base_law(options.truth);
  draft.training = draw_noise(options.noise, draft.parts.training, scatter);
  draft.validation = draw_noise(options.noise, draft.parts.validation, scatter);
  make_unlike(draft, options, tribology);
  if (!options.effect.empty()) {
    const EffectKind* kind = find_kind(options.effect);
    if (kind == nullptr) throw std::invalid_argument("effect " + options.effect);
    add_effect(draft, kind->make(draft.parts.training, cause), options.strength);
    if (!kind->answers.empty()) draft.causes = {{kind->name, kind->answers}};
  }
  record_oil(draft, options.effect);
  draft.hidden = not_recorded(draft.parts.training, draft.causes, recorder);
  return draft;
}

// --- as a file holds it
// ---------------------------------------------------------------------------

// Campaigns are filed by condition (as they were planned) or as they were run.
std::vector<std::size_t> filed(const Part& part, const Options& options, Random& random) {
  std::vector<std::size_t> order(part.tests());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const bool by_condition = random.below(2) == 0;
  const auto key = [&](std::size_t e) {
    const std::size_t row = part.first_row[e];
    const auto of = [&](const char* name) { return part.has(name) ? part.at(name)[row] : 0.0; };
    return std::array{of("T_tool_C"), of("v_rel_mm_s")};
  };
  if (!part.place.empty()) // look-alikes are filed as they were made
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return by_condition ? key(a) < key(b) : part.place[a] < part.place[b];
    });
  if (options.other_tests) random.shuffle(std::span<std::size_t>(order));
  return order;
}

bool is_stress(const std::string& name) {
  return name == "sigma_n_MPa" || name == "sigma_f_MPa" || name == "tau_R_MPa";
}

Column text_column(const std::string& name, const Part& part, const std::string& level) {
  return {name, "", Values(part.rows(), 0.0), {level}};
}

// A file knows the levels that are in it.
void drop_unused_levels(Column& column) {
  std::vector<std::string> used;
  Values number(column.levels.size());
  for (std::size_t level = 0; level < column.levels.size(); ++level) {
    number[level] = static_cast<double>(used.size());
    if (std::find(column.values.begin(), column.values.end(), static_cast<double>(level)) !=
        column.values.end())
      used.push_back(column.levels[level]);
  }
  if (used.size() == column.levels.size()) return;
  for (double& x : column.values)
    x = number[static_cast<std::size_t>(x)];
  column.levels = used;
}

std::vector<Column> recorded(const Part& part, const Values& tau, const Draft& draft,
                             const Options& options, Random& random) {
  std::vector<Column> columns;
  for (const Column& column : part.columns)
    if (std::find(draft.hidden.begin(), draft.hidden.end(), column.name) == draft.hidden.end())
      columns.push_back(column);
  columns.push_back({"tau_R_MPa", "", tau, {}});
  columns.push_back(text_column("origin", part, "synthetic"));
  for (Column& column : columns) {
    drop_unused_levels(column);
    if (const data::Quantity* quantity = data::find_quantity(column.name))
      column.unit = quantity->unit;
    if (is_stress(column.name))
      for (double& x : column.values)
        x *= options.stress_unit;
  }
  if (options.other_columns) random.shuffle(std::span<Column>(columns));
  return columns;
}

Dataset dataset_of(const Part& part, const Noise& scatter, const Draft& draft,
                   const Options& options, std::uint64_t which) {
  Random random(options.seed, which), shaken(options.seed, which + 1), mixed(options.seed, 40);
  Values tau = part.truth;
  for (std::size_t i = 0; i < tau.size(); ++i)
    tau[i] *= scatter.factor[i] * (1 + options.jitter * shaken.normal());
  Dataset data;
  data.columns = recorded(part, tau, draft, options, mixed);
  data.oracle_MPa = part.truth;
  for (double& x : data.oracle_MPa)
    x *= options.stress_unit;
  for (std::size_t e = 0; e < part.tests(); ++e)
    data.experiments.push_back(fmt::format("{}{:03}", which < 30 ? "test_" : "unseen_", e + 1));
  data.first_row = part.first_row;
  data.sources = {"synthetic"};
  return data;
}

// Values of rows, the tests in another order.
Values reordered(const Values& values, const std::vector<std::size_t>& first_row,
                 const std::vector<std::size_t>& order) {
  Values out;
  for (const std::size_t e : order)
    out.insert(out.end(), values.begin() + static_cast<std::ptrdiff_t>(first_row[e]),
               values.begin() + static_cast<std::ptrdiff_t>(first_row[e + 1]));
  return out;
}

// The same tests in another order.
Dataset reordered(const Dataset& data, const std::vector<std::size_t>& order) {
  Dataset out = data;
  out.experiments.clear();
  out.first_row = {0};
  out.oracle_MPa = reordered(data.oracle_MPa, data.first_row, order);
  for (Column& column : out.columns)
    column.values = reordered(column.values, data.first_row, order);
  for (const std::size_t e : order) {
    out.experiments.push_back(data.experiments[e]);
    out.first_row.push_back(out.first_row.back() + data.first_row[e + 1] - data.first_row[e]);
  }
  data::fingerprint(out);
  return out;
}

void shift(Part& part, const Options& options) {
  for (double& x : part.truth)
    x = x * (1 + options.shift_share) + options.shift_MPa;
}

double deviation(const Values& values) {
  const double n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double square = 0;
  for (const double x : values)
    square += (x - mean) * (x - mean);
  return std::sqrt(square / (n - 1));
}

Draft draft_of(const Options& options) {
  Random random(options.seed, 50);
  if (options.kind == "forging") return forging_draft(options);
  if (options.kind == "masked") return masked_draft(options, random);
  return look_alike_draft(options, random);
}

} // namespace

Campaign make_campaign(const Options& options) {
  Draft draft = draft_of(options);
  shift(draft.parts.validation, options);
  Campaign campaign;
  campaign.base = draft.base;
  campaign.causes = draft.causes;
  campaign.absorbed = draft.absorbed;
  campaign.gain_scatter = draft.training.gain_scatter;
  campaign.gain_sample = deviation(draft.training.gains);
  Random order(options.seed, 60);
  const auto files = filed(draft.parts.training, options, order);
  campaign.training =
      reordered(dataset_of(draft.parts.training, draft.training, draft, options, 20), files);
  Values planted;
  for (std::size_t i = 0; i < draft.parts.training.rows(); ++i)
    planted.push_back(std::log(draft.parts.training.truth[i] / draft.parts.training.law[i]));
  campaign.planted = reordered(planted, draft.parts.training.first_row, files);
  std::vector<std::size_t> as_made(draft.parts.validation.tests());
  std::iota(as_made.begin(), as_made.end(), std::size_t{0});
  campaign.validation =
      reordered(dataset_of(draft.parts.validation, draft.validation, draft, options, 30), as_made);
  return campaign;
}

} // namespace frictab::foreign
