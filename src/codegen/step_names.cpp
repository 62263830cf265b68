// Rules for names, one function per kind of step.
#include "codegen/step_names.h"

#include <algorithm>
#include <cctype>
#include <unordered_map>

#include <fmt/format.h>

#include "core/text.h"
#include "data/meaning.h"

namespace frictab::codegen {

using expr::Expr;
using expr::Op;

std::string short_name(const std::string& state) {
  std::string unit = data::meaning_of(state).unit;
  std::replace(unit.begin(), unit.end(), '/', '_');
  const std::string ending = unit == "degC" ? "_C" : "_" + unit;
  const bool ends = state.size() > ending.size() && state.ends_with(ending);
  return ends ? state.substr(0, state.size() - ending.size()) : state;
}

std::string value_name(const table::Table& table) {
  return table.quantity == models::PieceQuantity::mu ? "mu" : "tau_law";
}

namespace {

const char* const pressure = "sigma_n_MPa";
const char* const flow_stress = "sigma_f_MPa";

// Returns 2 for e2_x0, a parameter of the second traced effect; 0 for other names.
int effect_of(const std::string& parameter) {
  const std::size_t end = parameter.find_first_not_of("0123456789", 1);
  const bool found =
      parameter[0] == 'e' && end != parameter.npos && end > 1 && end < 6 && parameter[end] == '_';
  return found ? std::stoi(parameter.substr(1, end - 1)) : 0;
}

// The symbols of a subformula, by kind.
struct Holds {
  std::set<std::string> states;
  std::set<int> effects;
  bool value = false;
  bool parameters = false; // of the law itself

  void add(const Holds& other) {
    states.insert(other.states.begin(), other.states.end());
    effects.insert(other.effects.begin(), other.effects.end());
    value = value || other.value;
    parameters = parameters || other.parameters;
  }
  bool one_state() const { return states.size() == 1 && effects.empty() && !value && !parameters; }
  bool one_effect() const { return effects.size() == 1 && !value && !parameters; }
};

bool is_symbol(const Expr& e, const char* name) {
  return e.op() == Op::symbol && e.name() == name;
}
bool is_number(const Expr& e) {
  return e.op() == Op::constant;
}

class Namer {
public:
  explicit Namer(const table::Table& table) : table_(table) {}

  void name_steps(const Expr& formula) {
    for_each_part(formula, [this](const Expr& e) { name_step(e); });
  }

  // Visits the innermost first, so that each call needs only its operands.
  void find_symbols(const Expr& formula) {
    inside_out(formula, [this](const Expr& e) { holds(e); });
  }

  // Names the largest subformulas with parameters of one effect and nothing of the law: the
  // effect's factor or summand.
  void name_effects(const Expr& e) {
    const Holds& held = holds(e);
    if (held.effects.empty() || !visited_.insert(e.id()).second) return;
    if (held.one_effect() && !e.operands().empty()) return name_effect(e, *held.effects.begin());
    if (e.op() == Op::multiply && !held.value && !held.parameters) give(e, "effects", false);
    for (const Expr& operand : e.operands())
      name_effects(operand);
  }

  StepNames names;

private:
  const Holds& holds(const Expr& e) {
    if (const auto known = holds_.find(e.id()); known != holds_.end()) return known->second;
    Holds held;
    if (e.op() == Op::symbol) held = of_symbol(e.name());
    for (const Expr& operand : e.operands())
      held.add(holds(operand));
    return holds_.emplace(e.id(), std::move(held)).first->second;
  }

  Holds of_symbol(const std::string& name) const {
    Holds held;
    held.value = name == "value";
    if (held.value) return held;
    if (!table_.constants.count(name))
      held.states.insert(name);
    else if (const int effect = effect_of(name))
      held.effects.insert(effect);
    else
      held.parameters = true;
    return held;
  }

  void give(const Expr& e, const std::string& name, bool own_line) {
    names.try_emplace(e.id(), StepName{name, own_line});
  }

  void name_step(const Expr& e) {
    const auto& a = e.operands();
    switch (e.op()) {
    case Op::log:
      if (holds(e).one_state()) name_logarithm(e, short_name(*holds(e).states.begin()));
      break;
    case Op::multiply:
      if (is_number(a[0]) && is_symbol(a[1], flow_stress)) give(e, "k", true);
      if (is_symbol(a[1], pressure) && holds(a[0]).value && a[0].op() != Op::where_le)
        give(e, "tau_coulomb", false);
      break;
    case Op::divide:
      if (const std::string x = plain(a[0]), y = plain(a[1]); !x.empty() && !y.empty())
        give(e, x + "_per_" + y, false);
      break;
    case Op::minimum:
      name_minimum(e);
      break;
    default:
      break;
    }
  }

  void name_logarithm(const Expr& e, const std::string& state) {
    give(e, "ln_" + state, true);
    if (e.operands()[0].op() == Op::divide) give(e.operands()[0], state + "_rel", false);
  }

  void name_minimum(const Expr& e) {
    const auto& a = e.operands();
    if (a[0].op() == Op::maximum && a[0].operands()[0].op() == Op::symbol &&
        is_number(a[0].operands()[1]) && is_number(a[1]))
      give(e, short_name(a[0].operands()[0].name()) + "_held", false);
    if (!holds(a[0]).value || holds(a[1]).value || !holds(a[1]).states.count(flow_stress)) return;
    if (a[0].op() != Op::multiply) give(a[0], "tau_free", false);
    // The limit m k gets a name; the shear limit k alone has its own.
    if (a[1].op() != Op::multiply || is_number(a[1].operands()[0])) return;
    give(a[1], "limit", true);
    give(e, "tau_limited", false);
  }

  // Returns the name of a symbol, or of k, inside another name.
  std::string plain(const Expr& e) const {
    if (is_symbol(e, "value")) return value_name(table_);
    if (e.op() == Op::symbol) return short_name(e.name());
    const bool k = e.op() == Op::multiply && is_number(e.operands()[0]) &&
                   is_symbol(e.operands()[1], flow_stress);
    return k ? "k" : "";
  }

  // An effect adds 50*(F - 1), times a fading factor: its factor is F.
  void name_effect(Expr e, int effect) {
    while (e.op() == Op::multiply || e.op() == Op::subtract) {
      const auto& a = e.operands();
      const bool first = !holds(a[0]).effects.empty(), second = !holds(a[1]).effects.empty();
      if (first == second) break;
      const Expr part = a[first ? 0 : 1];
      if (part.operands().empty()) break;
      e = part;
    }
    std::string name = fmt::format("e{}", effect);
    for (const std::string& state : holds(e).states)
      name += "_" + short_name(state);
    give(e, name, true);
  }

  const table::Table& table_;
  std::unordered_map<const Expr::Node*, Holds> holds_;
  std::set<const Expr::Node*> visited_;
};

} // namespace

StepNames step_names(const std::vector<Wanted>& formulas, const table::Table& table) {
  Namer namer(table);
  for (const Wanted& wanted : formulas)
    namer.find_symbols(wanted.formula);
  if (!formulas.empty()) namer.name_effects(formulas[0].formula);
  for (const Wanted& wanted : formulas)
    namer.name_steps(wanted.formula);
  return namer.names;
}

} // namespace frictab::codegen
