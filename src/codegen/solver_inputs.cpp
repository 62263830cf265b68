// Reads the job's [export.inputs], checks them against a solver's table, and writes the table's
// Fortran for each state.
#include "codegen/solver_inputs.h"
#include "core/template.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "codegen/fixed_form.h"
#include "codegen/fortran_parts.h"
#include "codegen/histories.h"
#include "codegen/number_text.h"
#include "codegen/table_text.h"
#include "core/error.h"
#include "core/text.h"
#include "data/meaning.h"
#include "data/quantity.h"
#include "table/outside.h"

namespace frictab::codegen {

Place input_place(const std::string& name) {
  return at_job_key("export.inputs", name);
}

namespace {

// Returns the state's row in a solver's table: routines sum slip, which is both sliding distances.
std::string state_of(const std::string& name) {
  return name == "sliding_distance" ? "s_mm" : name;
}

// Reads the whole text as a number.
template <class Number> std::optional<Number> number(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

// True if the table clamps a value that the law does not.
bool clamps(const table::AxisEnds& axis, double value) {
  return axis.leaves(value) && !axis.extends(value);
}

// The choice of one state's source.
class Choice {
public:
  Choice(SolverInput& input, const SolverGives& gives, const table::Table& table, FaultList& faults)
      : input_(input), gives_(gives), axis_(table::find_axis(table, input.argument.name)),
        grows_(input.argument.name == "psi" && !gives.area.empty()),
        smooths_(input.argument.name == "v_rel_mm_s" && gives.smooths_speed),
        turns_(input.argument.name == direction_name), turn_(turn_of(table)), faults_(faults) {
    const std::string& name = input.argument.name;
    given_ = gives.find(state_of(name));
    const bool kept = is_further_history(name) && !gives.history.empty();
    if (kept)
      input.source = Source::history;
    else if (given_)
      input.source = Source::given;
    else
      input.source = gives.property.text.empty() ? Source::constant : Source::property;
    if (kept || given_) own_ = choice_of(name);
    if (given_) input.given = given_->state;
  }

  void read(std::string_view choice) {
    if (grows_ && choice == area_ratio) {
      input_.source = Source::history;
    } else if (smooths_ && choice.starts_with(smoothed)) {
      read_smoothing(choice.substr(smoothed.size()));
    } else if (turns_ && gives_.slips_in_space && choice.starts_with(along_slip)) {
      read_reference(choice.substr(along_slip.size()));
    } else if (own_ == "contact") {
      if (choice != own_)
        fault("the solver gives this state itself",
              smooths_ ? "leave the key out, or \"smoothed:20\" (increments)"
                       : "leave the key out");
    } else if (choice.starts_with("constant:")) {
      read_constant(choice.substr(9));
    } else if (choice.starts_with("field:") && !gives_.field.text.empty()) {
      const auto index = number<std::size_t>(choice.substr(6));
      input_.source = Source::field;
      input_.field = index.value_or(1);
      if (!index || *index < 1 || *index > 9999)
        fault(fmt::format("'{}' names no field variable", choice), "field:1");
    } else if (choice == "property" && !gives_.property.text.empty()) {
      input_.source = Source::property;
    } else if (own_.empty() || choice != own_) {
      fault(fmt::format("'{}' is not a source of a state", choice), "known: " + known_choices());
    }
  }

  // Condition under which a property replaces the solver's value.
  std::string without() const { return input_.source == Source::given ? given_->without : ""; }

  // The constant in canonical units, independent of the solver's.
  std::string constant_text() const {
    const std::string& unit = input_.argument.unit;
    return "constant " + shortest(*input_.fallback) + (unit == "1" ? "" : " " + unit);
  }

  bool needs_property() const { return input_.source == Source::property || !without().empty(); }

  std::string text() const {
    const std::map<std::string, std::string> numbers = {
        {"property", std::to_string(input_.property)},
        {"field", std::to_string(input_.field)},
        {"number", std::to_string(gives_.before_histories + input_.history)}};
    const std::string property = insert_names(gives_.property.text, numbers);
    const std::string unknown =
        turns_ && !given_ ? ", for all slips: their direction is not given" : "";
    switch (input_.source) {
    case Source::property:
      return property + unknown;
    case Source::field:
      return insert_names(gives_.field.text, numbers) + unknown;
    case Source::constant:
      return (input_.fallback ? constant_text() : "not known: NaN") + unknown;
    case Source::history:
      if (input_.smoothed_over > 0)
        return fmt::format("{}, smoothed over {} increments by {}", given_->text,
                           input_.smoothed_over, insert_names(gives_.history, numbers));
      if (grows_)
        return fmt::format("{} over that at its first contact, {}", gives_.area,
                           insert_names(gives_.history, numbers));
      return "from " + insert_names(gives_.history, numbers) + ", " +
             data::meaning_of(input_.argument.name).text;
    case Source::given:
      break;
    }
    const std::string given = turns_ ? direction_text() : given_->text;
    if (given_->without.empty()) return given;
    return fmt::format("{}; {} where {}", given, property, given_->without);
  }

private:
  std::string known_choices() const {
    std::string all = "constant:VALUE";
    if (!gives_.property.text.empty()) all += ", property";
    if (!gives_.field.text.empty()) all += ", field:N";
    if (!own_.empty()) all += ", " + own_;
    if (grows_) all += fmt::format(", {}", area_ratio);
    if (turns_ && gives_.slips_in_space) all += fmt::format(", {}X,Y,Z", along_slip);
    return all;
  }

  std::string direction_text() const {
    const Axis& to = input_.reference;
    const std::string text = insert_names(
        given_->text, {{"reference", fmt::format("{:.6g}, {:.6g}, {:.6g}", to[0], to[1], to[2])}});
    return fmt::format("{}; from {:g} to {:g}, 0 at rest", text, turn_.low, turn_.high());
  }

  // Reads a reference direction, "0,1,0", and makes its length 1.
  void read_reference(std::string_view text) {
    Axis to = {};
    bool understood = std::count(text.begin(), text.end(), ',') == 2;
    std::string_view rest = text;
    for (double& x : to) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      const auto value = number<double>(trimmed(rest.substr(0, comma)));
      understood = understood && value;
      x = value.value_or(0);
      rest.remove_prefix(std::min(comma + 1, rest.size()));
    }
    const double size = std::hypot(to[0], to[1], to[2]);
    if (!understood || !(size > 0) || !std::isfinite(size))
      return fault(fmt::format("'{}' is not a direction in the model's axes", text),
                   fmt::format("{}0,1,0", along_slip));
    for (std::size_t d = 0; d < to.size(); ++d)
      input_.reference[d] = to[d] / size;
  }

  void read_smoothing(std::string_view text) {
    const auto increments = number<std::size_t>(text);
    input_.source = Source::history;
    input_.smoothed_over = increments.value_or(2);
    if (!increments || *increments < 2 || *increments > 100000)
      fault(fmt::format("'{}' is not a number of increments from 2 to 100000", text),
            "smoothed:20");
  }

  void fault(const std::string& what, const std::string& hint) {
    faults_.add(input_place(input_.argument.name), what, hint);
  }

  void read_constant(std::string_view text) {
    const std::string& name = input_.argument.name;
    const auto value = number<double>(text);
    const data::Quantity* known = data::find_quantity(name);
    input_.source = Source::constant;
    input_.fallback = value;
    if (!value || !std::isfinite(*value))
      fault(fmt::format("'{}' is not a number", text), "constant:1.5");
    else if (axis_ && clamps(table::AxisEnds(*axis_), *value))
      fault(fmt::format("{} lies beyond the table's {:.6g} .. {:.6g}", text, axis_->nodes.front(),
                        axis_->nodes.back()),
            "a value inside, a wider range, or [table.axes." + name + "] outside = \"law\"");
    else if (known && *value < known->lowest)
      fault(fmt::format("{} is below the smallest possible {}", text, name),
            fmt::format("at least {} {}", known->lowest, known->unit));
  }

  // Returns the word by which the job requests the value of the solver or of the routine's own
  // memory.
  static std::string choice_of(const std::string& name) {
    const data::Quantity* known = data::find_quantity(name);
    if (name == direction_name) return "slip";
    return known ? known->choice : "state";
  }

  static constexpr std::string_view area_ratio = "area_ratio",
                                    smoothed = "smoothed:", along_slip = "slip:";

  SolverInput& input_;
  const SolverGives& gives_;
  const table::TableAxis* axis_; // null if the state is not an axis
  // The state grows by the area of contact; it may be smoothed; it is the direction of slip.
  bool grows_, smooths_, turns_;
  Turn turn_; // of that direction
  FaultList& faults_;
  const GivenState* given_ = nullptr;
  // Word for the value of the solver or the routine's own memory; empty: neither has one.
  std::string own_;
};

// Returns the value that is used if neither the deck nor the solver gives one.
std::optional<double> fallback(const table::Table& table, const std::string& name) {
  if (const auto typical = typical_value(table, name)) return typical;
  const data::Quantity* known = data::find_quantity(name);
  return known ? known->unknown : std::nullopt;
}

void check_names(const ExportRequest& request, const std::vector<std::string>& needed,
                 FaultList& faults) {
  std::vector<std::string> known = needed;
  for (const data::Quantity& quantity : data::quantities())
    if (quantity.state) known.push_back(quantity.name);
  // Reports misspelt names only: other names may belong to other tables of the same job.
  for (const auto& [name, choice] : request.inputs)
    if (std::find(known.begin(), known.end(), name) == known.end())
      if (const std::string near = nearest_name(name, known); !near.empty())
        faults.add(input_place(name), "no state of this name",
                   fmt::format("did you mean '{}'?", near));
}

} // namespace

const GivenState* SolverGives::find(const std::string& state) const {
  for (const GivenState& row : states)
    if (row.state == state) return &row;
  return nullptr;
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
    input.argument = argument_named(arguments, name);
    input.fallback = fallback(request.table, name);
    Choice choice(input, gives, request.table, faults);
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

table::FixedStates declared_constants(const ExportRequest& request,
                                      const std::vector<SolverInput>& inputs) {
  table::FixedStates held;
  for (const SolverInput& input : inputs)
    if (input.source == Source::constant && input.fallback &&
        request.input_or_empty(input.argument.name).starts_with("constant:"))
      held[input.argument.name] = *input.fallback;
  return held;
}

std::size_t property_count(const std::vector<SolverInput>& inputs) {
  std::size_t count = 0;
  for (const SolverInput& input : inputs)
    count = std::max(count, input.property);
  return count;
}

bool takes(const std::vector<SolverInput>& inputs, const std::string& state) {
  return std::any_of(inputs.begin(), inputs.end(), [&](const SolverInput& input) {
    return input.source == Source::given && input.given == state;
  });
}

void add_direction_of_driver(TemplateValues& values, const std::vector<SolverInput>& inputs) {
  values.flags["directs"] = takes(inputs, std::string(direction_name));
  values.offered.insert("directs");
  for (const SolverInput& input : inputs) {
    if (input.argument.name != direction_name) continue;
    for (std::size_t d = 0; d < input.reference.size(); ++d) {
      const std::string name = "reference_" + std::to_string(d + 1);
      values.text[name] = fortran_number(input.reference[d]);
      values.offered.insert(name);
    }
  }
}

bool uses(const std::vector<SolverInput>& inputs, Source source) {
  return std::any_of(inputs.begin(), inputs.end(),
                     [&](const SolverInput& input) { return input.source == source; });
}

std::string meaning_and_unit(const SolverInput& input) {
  const InputArgument& of = input.argument;
  return of.solver.name == "1" ? of.meaning : of.meaning + ", " + of.solver.name;
}

namespace {

// Returns the property's value if the deck gives none, in the solver's unit; empty: not known.
std::string value_where_absent(const SolverInput& input) {
  if (!input.fallback) return "";
  return fmt::format("{:.6g}", input.argument.solver.from_canonical(*input.fallback));
}

} // namespace

std::vector<Placeholder> property_placeholders(const std::vector<SolverInput>& inputs,
                                               const FurtherProperties& further) {
  std::vector<Placeholder> places;
  for (const SolverInput& input : inputs)
    if (input.property)
      places.push_back({"<" + meaning_and_unit(input) + ">", value_where_absent(input),
                        fmt::format("property {}: {}", input.property, meaning_and_unit(input))});
  for (const FurtherProperty& property : further)
    places.push_back({property.placeholder, fmt::format("{:.6g}", property.where_absent),
                      fmt::format("property {}: {}", property.number, property.meaning)});
  return places;
}

namespace fortran {

namespace {

const GivenState& row_of(const SolverInput& input, const SolverGives& gives) {
  static const GivenState continued = {.part = "ftpast"}; // ftpast fills these itself
  switch (input.source) {
  case Source::given:
    return *gives.find(input.given);
  case Source::property:
    return gives.property;
  case Source::field:
    return gives.field;
  case Source::constant:
    return gives.constant;
  case Source::history:
    break;
  }
  return continued;
}

// Writes one state's statements.
class Statements {
public:
  Statements(const SolverInput& input, std::size_t index, std::size_t indent)
      : input_(input), indent_(indent) {
    names_ = {{"x", fmt::format("x({})", index)},
              {"index", std::to_string(index)},
              {"property", std::to_string(input.property)},
              {"field", std::to_string(input.field)},
              {"fallback", input.fallback ? fortran_number(*input.fallback) : "ftqnan()"},
              {"convert", to_canonical_text(input.argument.solver, Notation::fortran)}};
  }

  std::string out;

  void comment(const std::string& text) {
    for (const TemplateValues& line : comments({text}, indent_))
      add("C     " + line.text.at("text"));
  }

  // Writes a statement per line, with its own leading blanks.
  void write(std::string_view lines, std::size_t deeper = 0) {
    for (const std::string_view line : lines_of(lines))
      add(fixed_form(std::string(indent_ + deeper, ' ') + insert_names(line, names_)));
  }

  void read(const GivenState& row, const GivenState& property) {
    if (row.exists.empty()) return value(row, 0);
    write("if (" + row.exists + ") then");
    value(row, 2);
    write("else");
    write("@{x} = " + (row.absent.empty() ? "@{fallback}" : row.absent), 2);
    if (input_.source == Source::given && input_.property > 0) {
      write("if (" + property.exists + ") then", 2);
      value(property, 4);
      write("end if", 2);
    }
    write("end if");
  }

  std::map<std::string, std::string>& names() { return names_; }

private:
  void add(const std::string& line) { out += (out.empty() ? "" : "\n") + line; }

  void value(const GivenState& row, std::size_t deeper) {
    const bool converts = !row.canonical && !input_.argument.solver.same();
    if (row.read.find("@{x}") == std::string::npos)
      return write("@{x} = " + row.read + (converts ? "@{convert}" : ""), deeper);
    write(row.read, deeper);
    if (converts) write("@{x} = @{x}@{convert}", deeper);
  }

  const SolverInput& input_;
  std::size_t indent_;
  std::map<std::string, std::string> names_;
};

} // namespace

std::string reads(const std::vector<SolverInput>& inputs, const SolverGives& gives,
                  const std::string& part, std::size_t indent) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const GivenState& row = row_of(inputs[i], gives);
    if (row.part != part || row.read.empty()) continue;
    Statements one(inputs[i], i + 1, indent);
    one.comment(inputs[i].argument.name + ": " + inputs[i].text);
    one.read(row, gives.property);
    all.push_back(std::move(one.out));
  }
  if (inputs.empty() && gives.constant.part == part) { // x(1) exists even then
    const SolverInput none;
    Statements one(none, 1, indent);
    one.comment("no state is needed");
    one.write("@{x} = 0.0D0");
    all.push_back(std::move(one.out));
  }
  return join(all, "\n");
}

std::string slopes(const std::vector<SolverInput>& inputs, const SolverGives& gives,
                   const std::map<std::string, std::string>& names, std::size_t indent) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const GivenState& row = row_of(inputs[i], gives);
    if (row.slope.empty()) continue;
    Statements one(inputs[i], i + 1, indent);
    one.names().insert(names.begin(), names.end());
    one.write(row.slope);
    all.push_back(std::move(one.out));
  }
  return join(all, "\n");
}

void add_direction(TemplateValues& values, const ExportRequest& request,
                   const std::vector<SolverInput>& inputs, const SolverGives& gives) {
  values.flags["directs"] = takes(inputs, std::string(direction_name));
  values.text["direction_text"];
  for (const SolverInput& input : inputs)
    if (values.flags["directs"] && input.argument.name == direction_name)
      values.text["direction_text"] =
          direction_functions(turn_of(request.table),
                              gives.slips_in_space ? std::optional(input.reference) : std::nullopt);
}

bool needs_unknown(const std::vector<SolverInput>& inputs, const SolverGives& gives) {
  return std::any_of(inputs.begin(), inputs.end(), [&](const SolverInput& input) {
    const GivenState& row = row_of(input, gives);
    const bool stands_in = input.source == Source::constant || !row.exists.empty();
    return stands_in && row.absent.empty() && !input.fallback;
  });
}

} // namespace fortran

std::vector<std::string> state_lines(const ExportRequest& request,
                                     const std::vector<SolverInput>& inputs) {
  std::vector<std::string> lines;
  for (const SolverInput& input : inputs)
    lines.push_back(fmt::format("{}: {}; {}", input.argument.argument, input.text,
                                range_text(input.argument, request.table)));
  if (lines.empty()) lines.push_back("none");
  return lines;
}

std::vector<std::string> property_lines(const std::vector<SolverInput>& inputs,
                                        const FurtherProperties& further) {
  std::vector<std::string> lines;
  for (const SolverInput& input : inputs) {
    if (input.property == 0) continue;
    const SolverUnit& unit = input.argument.solver;
    const std::string value = value_where_absent(input);
    const std::string absent = value.empty() ? "not known: NaN until it is given" : value;
    lines.push_back(fmt::format("{} {}, {} ({}){}", input.property, input.argument.meaning,
                                unit.name, absent,
                                input.without.empty() ? "" : ", reference where " + input.without));
  }
  for (const FurtherProperty& property : further)
    lines.push_back(fmt::format("{} {}", property.number, property.line));
  if (lines.empty()) lines.push_back("none");
  return lines;
}

} // namespace frictab::codegen
