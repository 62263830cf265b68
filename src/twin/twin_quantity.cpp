// Computes the causes of effects: columns, histories, hidden causes.
#include "twin/twin_quantity.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/names.h"
#include "core/random.h"
#include "core/text.h"
#include "data/derived.h"

namespace frictab::twin {

namespace {

constexpr unsigned latent_stream = 16; // random stream of hidden causes

// Draws one value per position in the order of tests.
std::vector<double> latent_by_order(const std::string& kind, Random& random, std::size_t tests) {
  std::vector<double> values(tests);
  const std::size_t batch = std::max<std::size_t>(1, tests / 8);
  double level = 0;
  for (std::size_t i = 0; i < tests; ++i) {
    if (kind == "drift")
      values[i] = static_cast<double>(i) / static_cast<double>(tests);
    else if (kind == "groups")
      values[i] = random.uniform() < 0.5 ? 0 : 1;
    else if (kind == "order")
      values[i] = level += random.normal();
    else if (kind == "batch")
      values[i] = level = i % batch == 0 ? random.normal() : level;
    else
      values[i] = random.normal();
  }
  return values;
}

std::vector<double> latent(const TwinOptions& options, std::size_t effect, std::size_t tests,
                           const TwinDraft& draft) {
  Random random(options.seed, twin_stream(2, effect, latent_stream));
  const auto values = latent_by_order(options.effects[effect].latent, random, tests);
  std::vector<double> rows;
  rows.reserve(draft.data.rows());
  for (const TwinExperiment& experiment : draft.plan)
    rows.insert(rows.end(), options.design->points, values[experiment.run_order - 1]);
  return rows;
}

std::vector<std::string> known_columns(const TwinDraft& draft) {
  std::vector<std::string> names = all_names(draft.data.columns, &data::Column::name);
  std::erase(names, "tau_R_MPa");
  for (const data::DerivedQuantity& quantity : data::derived_quantities())
    names.push_back(quantity.name);
  names.push_back("latent");
  return names;
}

} // namespace

std::vector<double> quantity_rows(const TwinOptions& options, std::size_t effect,
                                  const std::string& name, std::size_t tests,
                                  const TwinDraft& draft) {
  if (name == "latent") return latent(options, effect, tests, draft);
  if (const data::Column* column = draft.data.find(name)) return column->values;
  return data::derive(*data::find_derived(name), draft.data, base_tau(draft));
}

void check_column(const EffectSpec& spec, const std::string& name, const TwinDraft& draft,
                  FaultList& faults) {
  if (spec.on == effects::ActsOn::m && draft.law && !draft.law->has_limit())
    faults.add({"--effect"}, "law '" + draft.law->law().name + "' has no limit to act on",
               "it is a limit itself: use on=mu");
  const auto known = known_columns(draft);
  if (std::ranges::find(known, name) == known.end()) {
    faults.add({"--effect"}, "unknown column '" + name + "'", suggest(name, known));
    return;
  }
  const data::Column* column = draft.data.find(name);
  const bool text = column != nullptr && !column->levels.empty();
  const std::size_t texts = effects::find_effect(spec.form)->texts;
  const bool categorical =
      texts > 1 || (texts == 1 && name == spec.column); // the column that it takes is of text
  if (text && !categorical)
    faults.add({"--effect"},
               fmt::format("column '{}' holds text, form '{}' needs numbers", name, spec.form),
               "use form=category");
  if (!text && categorical && name != "latent")
    faults.add({"--effect"},
               fmt::format("column '{}' holds numbers, form '{}' needs text", name, spec.form),
               "use column=tool, or another form");
}

} // namespace frictab::twin
