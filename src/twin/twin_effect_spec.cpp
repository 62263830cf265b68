// Parses the --effect option.
#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"
#include "twin/twin.h"
#include "twin/twin_text.h"

namespace frictab::twin {

namespace {

const std::string option = "--effect";

std::vector<std::string> known_keys(const effects::EffectForm* form) {
  std::vector<std::string> keys = {"form",   "column",   "column2",   "column3", "on",
                                   "latent", "strength", "amplitude", "sign"};
  if (form != nullptr)
    for (std::size_t i = 1; i < form->parameters.size(); ++i)
      keys.push_back(form->parameters[i].name);
  return keys;
}

void check_choice(const KeyValue& item, const std::vector<std::string>& choices,
                  FaultList& faults) {
  if (std::ranges::find(choices, item.value) == choices.end())
    faults.add({option}, "unknown " + item.key + " '" + item.value + "'",
               "known: " + join(choices, ", "));
}

void read_sign(const KeyValue& item, EffectSpec& spec, FaultList& faults) {
  if (item.value == "+") spec.sign = 1;
  if (item.value == "-") spec.sign = -1;
  if (spec.sign == 0) faults.add({option}, "sign must be + or -, not '" + item.value + "'");
}

void read_strength(const KeyValue& item, EffectSpec& spec, FaultList& faults) {
  spec.strength = read_number(item, faults);
  if (*spec.strength < 0)
    faults.add({option}, "strength is negative",
               "strength 0.15 raises the error of the law without the effect by 15 %; use sign=-");
}

void read_shape(const KeyValue& item, const effects::EffectForm* form, EffectSpec& spec,
                FaultList& faults) {
  if (form == nullptr) return;
  for (const models::Parameter& parameter : form->parameters) {
    if (parameter.name != item.key) continue;
    const double value = read_number(item, faults);
    if (value < parameter.lower || value > parameter.upper)
      faults.add({option}, item.key + " = " + item.value + " is out of bounds",
                 shortest(parameter.lower) + " to " + shortest(parameter.upper));
    spec.shapes[item.key] = value;
  }
}

void read_item(const KeyValue& item, const effects::EffectForm* form, EffectSpec& spec,
               FaultList& faults) {
  if (item.key == "form")
    spec.form = item.value;
  else if (item.key == "column")
    spec.column = item.value;
  else if (item.key == "column2")
    spec.column2 = item.value;
  else if (item.key == "column3")
    spec.column3 = item.value;
  else if (item.key == "strength")
    read_strength(item, spec, faults);
  else if (item.key == "amplitude")
    spec.amplitude = read_number(item, faults);
  else if (item.key == "sign")
    read_sign(item, spec, faults);
  else if (item.key == "on") {
    check_choice(item, {"mu", "m", "tau"}, faults);
    spec.on = effects::find_acts_on(item.value).value_or(spec.on);
  } else if (item.key == "latent") {
    check_choice(item, {"random", "groups", "batch", "drift", "order"}, faults);
    spec.latent = item.value;
  } else
    read_shape(item, form, spec, faults);
}

void check_whole(const EffectSpec& spec, const effects::EffectForm* form, FaultList& faults) {
  const auto names = effects::effect_names();
  if (spec.form.empty())
    faults.add({option}, "no form is given", "known: " + join(names, ", "));
  else if (form == nullptr)
    faults.add({option}, "unknown form '" + spec.form + "'", suggest(spec.form, names));
  if (spec.column.empty())
    faults.add({option}, "no column is given", "for example column=s_mm, or column=latent");
  if (spec.strength.has_value() == spec.amplitude.has_value())
    faults.add({option},
               spec.strength ? "strength and amplitude are both given"
                             : "neither strength nor amplitude is given",
               "strength=0.15 raises the error of the law without the effect by 15 %");
  if (form == nullptr) return;
  const std::string* given[] = {&spec.column2, &spec.column3};
  for (std::size_t i = 0; i < 2; ++i)
    if (const bool takes = form->columns > i + 1; takes == given[i]->empty())
      faults.add({option}, fmt::format("form '{}' {} column{}", form->name,
                                       takes ? "needs" : "takes no", i + 2));
}

// The form decides which other keys are known, so it is found before the keys are checked.
const effects::EffectForm* form_named_in(std::string_view text) {
  FaultList ignored;
  const std::vector<std::string> only = {"form"};
  for (const KeyValue& item : read_pairs(text, ',', option, only, ignored))
    return effects::find_effect(item.value);
  return nullptr;
}

} // namespace

std::vector<std::string> columns_of(const EffectSpec& spec) {
  std::vector<std::string> columns{spec.column};
  for (const std::string* further : {&spec.column2, &spec.column3})
    if (!further->empty()) columns.push_back(*further);
  return columns;
}

EffectSpec parse_effect(std::string_view text) {
  FaultList faults;
  EffectSpec spec;
  const effects::EffectForm* form = form_named_in(text);
  for (const KeyValue& item : read_pairs(text, ',', option, known_keys(form), faults)) {
    read_item(item, form, spec, faults);
    if (item.key == "column" && spec.form.empty() && item.value == "latent") spec.form = "linear";
  }
  check_whole(spec, form == nullptr ? effects::find_effect(spec.form) : form, faults);
  faults.throw_if_any();
  return spec;
}

} // namespace frictab::twin
