// Reads the job's [export.inputs] against what a solver gives.
#include "codegen/solver_inputs.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "codegen/fortran_parts.h"
#include "codegen/histories.h"
#include "core/error.h"
#include "core/text.h"
#include "data/meaning.h"
#include "data/quantity.h"

namespace frictab {

namespace {

struct SourceName {
  Source source;
  const char* flag;   // for templates
  const char* choice; // in [export.inputs], where it is the solver's own; empty: not to be chosen
};
constexpr std::array source_names = {
    SourceName{Source::pressure, "is_pressure", "contact"},
    SourceName{Source::speed, "is_speed", "contact"},
    SourceName{Source::slip, "is_slip", "state"},
    SourceName{Source::work, "is_work", "state"},
    SourceName{Source::peak_pressure, "is_peak", "state"},
    SourceName{Source::history, "", "state"},
    SourceName{Source::temperature, "is_temperature", "temperature"},
    SourceName{Source::flow_stress, "is_flow_stress", "solver"},
    SourceName{Source::expansion, "is_expansion", "solver"},
    SourceName{Source::property, "is_property", ""},
    SourceName{Source::field, "is_field", ""},
    SourceName{Source::constant, "is_constant", ""}};

const SourceName& name_of(Source source) {
  return *std::find_if(source_names.begin(), source_names.end(),
                       [&](const SourceName& n) { return n.source == source; });
}

std::optional<Source> natural_source(const std::string& name) {
  static const std::map<std::string, Source> sources = {{"sigma_n_MPa", Source::pressure},
                                                        {"v_rel_mm_s", Source::speed},
                                                        {"s_mm", Source::slip},
                                                        {"sliding_distance", Source::slip},
                                                        {"friction_work", Source::work},
                                                        {"peak_sigma_n", Source::peak_pressure},
                                                        {"T_contact_C", Source::temperature},
                                                        {"sigma_f_MPa", Source::flow_stress},
                                                        {"psi", Source::expansion}};
  if (is_further_history(name)) return Source::history;
  const auto found = sources.find(name);
  return found == sources.end() ? std::nullopt : std::optional(found->second);
}

Place place(const std::string& name) {
  return {"export.inputs." + name, 0, 0};
}

// The whole text as a number.
template <class Number> std::optional<Number> number(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

// One state's choice.
class Choice {
public:
  Choice(SolverInput& input, const SolverGives& gives, FaultList& faults)
      : input_(input), gives_(gives), faults_(faults) {
    const auto natural = natural_source(input.argument.name);
    for (const SolverGives::State& state : gives.states)
      if (natural && state.source == *natural) given_ = &state;
    input.source = given_                    ? given_->source
                   : !gives.property.empty() ? Source::property
                                             : Source::constant;
  }

  void read(std::string_view choice) {
    const std::string own = given_ ? name_of(given_->source).choice : "";
    if (own == "contact") {
      if (choice != own) fault("the solver gives this state itself", "leave the key out");
    } else if (choice.starts_with("constant:")) {
      read_constant(choice.substr(9));
    } else if (choice.starts_with("field:") && !gives_.field.empty()) {
      const auto index = number<std::size_t>(choice.substr(6));
      input_.source = Source::field;
      input_.field = index.value_or(1);
      if (!index || *index < 1 || *index > 9999)
        fault(fmt::format("'{}' names no field variable", choice), "field:1");
    } else if (choice == "property" && !gives_.property.empty()) {
      input_.source = Source::property;
    } else if (own.empty() || choice != own) {
      fault(fmt::format("'{}' is no source of a state", choice),
            fmt::format("known: constant:VALUE{}{}{}", gives_.property.empty() ? "" : ", property",
                        gives_.field.empty() ? "" : ", field:N", own.empty() ? "" : ", " + own));
    }
  }

  // When a property stands in for what the solver gives.
  std::string without() const {
    return given_ && input_.source == given_->source ? given_->without : "";
  }

  bool needs_property() const { return input_.source == Source::property || !without().empty(); }

  std::string text() const {
    const std::string property = fmt::format(fmt::runtime(gives_.property), input_.property);
    switch (input_.source) {
    case Source::property:
      return property;
    case Source::field:
      return fmt::format(fmt::runtime(gives_.field), input_.field);
    case Source::constant:
      return input_.fallback ? "constant " + shortest(*input_.fallback) : "not known: NaN";
    case Source::history:
      return "from " +
             fmt::format(fmt::runtime(given_->text), gives_.before_histories + input_.history) +
             ", " + meaning_of(input_.argument.name).text;
    default:
      return given_->text + (given_->without.empty()
                                 ? ""
                                 : fmt::format("; {} where {}", property, given_->without));
    }
  }

private:
  void fault(const std::string& what, const std::string& hint) {
    faults_.add(place(input_.argument.name), what, hint);
  }

  void read_constant(std::string_view text) {
    const std::string& name = input_.argument.name;
    const auto value = number<double>(text);
    const Quantity* known = find_quantity(name);
    input_.source = Source::constant;
    input_.fallback = value;
    if (!value || !std::isfinite(*value))
      fault(fmt::format("'{}' is not a number", text), "constant:1.5");
    else if (known && *value < known->lowest)
      fault(fmt::format("{} is below the smallest possible {}", text, name),
            fmt::format("at least {} {}", known->lowest, known->unit));
  }

  SolverInput& input_;
  const SolverGives& gives_;
  FaultList& faults_;
  const SolverGives::State* given_ = nullptr;
};

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

std::string fortran_conversion(const SolverUnit& unit) {
  if (unit.times != 1) return "*" + fortran_number(unit.times);
  return unit.over != 1 ? "/" + fortran_number(unit.over) : "";
}

std::vector<SolverInput> solver_inputs(const ExportRequest& request, const SolverGives& gives) {
  FaultList faults;
  const std::vector<std::string> needed = request.table.inputs();
  const std::vector<InputArgument> arguments = entry_arguments(request.table, request.units);
  std::vector<SolverInput> inputs;
  std::size_t properties = 0, histories = 0;
  bool warm = false;
  const auto add = [&](const std::string& name) {
    SolverInput input;
    input.argument = *std::find_if(arguments.begin(), arguments.end(),
                                   [&](const InputArgument& a) { return a.name == name; });
    input.fallback = fallback(request.table, name);
    Choice choice(input, gives, faults);
    if (const auto said = request.inputs.find(name); said != request.inputs.end())
      choice.read(said->second);
    if (choice.needs_property()) input.property = ++properties;
    if (input.source == Source::history) {
      input.history = ++histories;
      warm = warm || follows_temperature(name);
    }
    input.text = choice.text();
    input.without = choice.without();
    inputs.push_back(std::move(input));
  };
  check_names(request, needed, faults);
  for (const std::string& name : needed)
    add(name);
  if (warm && std::find(needed.begin(), needed.end(), "T_contact_C") == needed.end())
    add("T_contact_C");
  faults.throw_if_any();
  return inputs;
}

std::size_t property_count(const std::vector<SolverInput>& inputs) {
  std::size_t count = 0;
  for (const SolverInput& input : inputs)
    count = std::max(count, input.property);
  return count;
}

bool uses(const std::vector<SolverInput>& inputs, Source source) {
  return std::any_of(inputs.begin(), inputs.end(),
                     [&](const SolverInput& input) { return input.source == source; });
}

std::vector<std::string> property_values(const std::vector<SolverInput>& inputs) {
  std::vector<std::string> values;
  for (const SolverInput& input : inputs)
    if (input.property)
      values.push_back(input.fallback ? fmt::format("{:.6g}", input.argument.solver.from_canonical(
                                                                  *input.fallback))
                                      : "<" + input.argument.argument + ">");
  return values;
}

std::vector<TemplateValues> fortran_inputs(const std::vector<SolverInput>& inputs,
                                           const SolverGives& gives) {
  std::vector<SolverInput> all = inputs;
  if (all.empty()) { // x(1) exists even where the law needs no state
    all.emplace_back();
    all[0].source = Source::constant;
    all[0].fallback = 0.0;
  }
  std::vector<TemplateValues> list;
  for (const SolverInput& input : all) {
    TemplateValues values;
    const std::string convert = fortran_conversion(input.argument.solver);
    values.text = {
        {"index", std::to_string(list.size() + 1)},
        {"comment", fortran::clip(inputs.empty() ? "no state is needed"
                                                 : input.argument.name + ": " + input.text)},
        {"fallback", input.fallback ? fortran_number(*input.fallback) : "ftqnan()"},
        {"property", std::to_string(input.property)},
        {"field", std::to_string(input.field)},
        {"convert", convert}};
    values.flags["converts"] = !convert.empty();
    const auto flag = [&](Source source) {
      values.flags[name_of(source).flag] = input.source == source;
    };
    for (const SolverGives::State& state : gives.states)
      if (state.source != Source::history) flag(state.source); // these are filled by ftpast
    flag(Source::constant);
    if (!gives.property.empty()) flag(Source::property);
    if (!gives.field.empty()) flag(Source::field);
    list.push_back(std::move(values));
  }
  return list;
}

std::vector<std::string> state_lines(const ExportRequest& request,
                                     const std::vector<SolverInput>& inputs) {
  std::vector<std::string> lines;
  for (const SolverInput& input : inputs)
    lines.push_back(fmt::format("{}: {}; {}", input.argument.argument, input.text,
                                range_text(input.argument, request.table)));
  if (lines.empty()) lines.push_back("none");
  return lines;
}

std::vector<std::string> property_lines(const std::vector<SolverInput>& inputs) {
  std::vector<std::string> lines;
  for (const SolverInput& input : inputs) {
    if (input.property == 0) continue;
    const SolverUnit& unit = input.argument.solver;
    const std::string absent = input.fallback
                                   ? fmt::format("{:.6g}", unit.from_canonical(*input.fallback))
                                   : "not known: NaN until it is given";
    lines.push_back(fmt::format("{} {}, {} ({}){}", input.property, input.argument.meaning,
                                unit.name, absent,
                                input.without.empty() ? "" : ", reference where " + input.without));
  }
  if (lines.empty()) lines.push_back("none");
  return lines;
}

} // namespace frictab
