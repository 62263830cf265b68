// Reads the job's [export.inputs] for VFRIC: what the solver gives, and what it has to be told.
#include "inputs.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "data/quantity.h"

namespace frictab::abaqus_vfric {

namespace {

Place place(const std::string& name) {
  return {"export.inputs." + name, 0, 0};
}

Source default_source(const std::string& name) {
  if (name == "sigma_n_MPa") return Source::pressure;
  if (name == "v_rel_mm_s") return Source::speed;
  if (name == "s_mm") return Source::slip;
  if (name == "T_contact_C") return Source::temperature;
  return Source::property;
}

// The whole text as a number.
template <class Number> std::optional<Number> number(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

void read_constant(VfricInput& input, std::string_view text, FaultList& faults) {
  const std::string& name = input.argument.name;
  const auto value = number<double>(text);
  const Quantity* known = find_quantity(name);
  input.source = Source::constant;
  input.fallback = value;
  if (!value || !std::isfinite(*value))
    faults.add(place(name), fmt::format("'{}' is not a number", text), "constant:1.5");
  else if (known && *value < known->lowest)
    faults.add(place(name), fmt::format("{} is below the smallest possible {}", text, name),
               fmt::format("at least {} {}", known->lowest, known->unit));
}

void read_choice(VfricInput& input, std::string_view choice, FaultList& faults) {
  const std::string& name = input.argument.name;
  const Source given = default_source(name);
  if (given == Source::pressure || given == Source::speed) {
    if (choice != "contact")
      faults.add(place(name), "the solver gives this state itself", "leave the key out");
  } else if (choice.substr(0, 9) == "constant:") {
    read_constant(input, choice.substr(9), faults);
  } else if (choice.substr(0, 6) == "field:") {
    const auto index = number<std::size_t>(choice.substr(6));
    input.source = Source::field;
    input.field = index.value_or(1);
    if (!index || *index < 1 || *index > 9999)
      faults.add(place(name), fmt::format("'{}' names no field variable", choice), "field:1");
  } else if (choice == "property") {
    input.source = Source::property;
  } else if ((given != Source::slip || choice != "state") &&
             (given != Source::temperature || choice != "temperature")) {
    const std::string own = given == Source::slip          ? ", state"
                            : given == Source::temperature ? ", temperature"
                                                           : "";
    faults.add(place(name), fmt::format("'{}' is no source of a state", choice),
               "known: constant:VALUE, property, field:N" + own);
  }
}

// What stands in where the deck or the solver gives nothing.
std::optional<double> fallback(const Table& table, const std::string& name) {
  if (const auto typical = typical_value(table, name)) return typical;
  if (name == "psi") return 1.0;
  if (name == "T_contact_C") return 20.0;
  if (name == "s_mm") return 0.0;
  return std::nullopt;
}

void check_names(const ExportRequest& request, const std::vector<std::string>& needed,
                 FaultList& faults) {
  std::vector<std::string> known = needed;
  for (const Quantity& quantity : quantities())
    if (quantity.state) known.push_back(quantity.name);
  // Columns of other tables of the same job are not ours to judge; typing errors are.
  for (const auto& [name, choice] : request.inputs)
    if (std::find(known.begin(), known.end(), name) == known.end())
      if (const std::string near = nearest_name(name, known); !near.empty())
        faults.add(place(name), "no state of this name", fmt::format("did you mean '{}'?", near));
}

} // namespace

std::vector<VfricInput> vfric_inputs(const ExportRequest& request) {
  FaultList faults;
  const std::vector<std::string> needed = request.table.inputs();
  const std::vector<InputArgument> arguments = entry_arguments(request.table, request.units);
  std::vector<VfricInput> inputs;
  std::size_t properties = 0;
  check_names(request, needed, faults);
  for (const std::string& name : needed) {
    VfricInput input;
    input.argument = *std::find_if(arguments.begin(), arguments.end(),
                                   [&](const InputArgument& a) { return a.name == name; });
    input.source = default_source(name);
    input.fallback = fallback(request.table, name);
    if (const auto choice = request.inputs.find(name); choice != request.inputs.end())
      read_choice(input, choice->second, faults);
    if (input.source == Source::property || input.source == Source::temperature)
      input.property = ++properties;
    inputs.push_back(std::move(input));
  }
  faults.throw_if_any();
  return inputs;
}

std::size_t property_count(const std::vector<VfricInput>& inputs) {
  std::size_t count = 0;
  for (const VfricInput& input : inputs)
    count = std::max(count, input.property);
  return count;
}

std::string source_text(const VfricInput& input) {
  switch (input.source) {
  case Source::pressure:
    return "fNormal/areaSec of the surface node";
  case Source::speed:
    return "|dSlipFric|/dTimCur (0 where dTimCur = 0)";
  case Source::slip:
    return "STATEV(1), accumulated slip under pressure";
  case Source::temperature:
    return fmt::format("mean of both surfaces; property {} where nTemp = 0", input.property);
  case Source::property:
    return fmt::format("property {}", input.property);
  case Source::field:
    return fmt::format("mean of both surfaces' predefined field {}", input.field);
  case Source::constant:
    break;
  }
  return fmt::format("constant {}", shortest(input.fallback.value_or(0)));
}

} // namespace frictab::abaqus_vfric
