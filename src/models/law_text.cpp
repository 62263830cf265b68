// Builds a Law from a text: checks names, parses formulas and splits them into two parts.
#include "models/law_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>

#include "core/text.h"
#include "data/derived.h"
#include "data/quantity.h"
#include "expr/program.h"
#include "models/symbols.h"

namespace frictab::models {

using expr::Expr;
using expr::Op;

namespace {

constexpr const char* shear_yield_symbol = "k_MPa";
constexpr const char* flow_stress_symbol = "sigma_f_over_k"; // only in the registry's texts
constexpr std::size_t longest_name = 40;

// ---- the two parts ----

bool is_kink(Op op) {
  return op == Op::minimum || op == Op::maximum || op == Op::where_le;
}

// Returns axis and place of a kink such as max(v_rel_mm_s, 10), where the table gets a node. A
// where() does not qualify, because its branches may differ there.
std::optional<std::pair<std::string, double>> place_on_axis(const Expr& e) {
  if (e.op() != Op::minimum && e.op() != Op::maximum) return std::nullopt;
  for (const int state : {0, 1}) {
    const Expr &a = e.operands()[state], &b = e.operands()[1 - state];
    if (a.op() == Op::symbol && b.op() == Op::constant && data::find_quantity(a.name()))
      return std::pair(a.name(), b.value());
  }
  return std::nullopt;
}

// Adds the factors of a product; divisors are skipped.
void add_factors(const Expr& e, std::vector<Expr>& factors) {
  if (e.op() == Op::multiply) {
    for (const Expr& operand : e.operands())
      add_factors(operand, factors);
  } else if (e.op() == Op::divide) {
    add_factors(e.operands()[0], factors);
  } else {
    factors.push_back(e);
  }
}

bool is_pressure(const Expr& e) {
  return e.op() == Op::symbol && e.name() == "sigma_n_MPa";
}

bool has_pressure_factor(const Expr& e) {
  std::vector<Expr> factors;
  add_factors(e, factors);
  return std::ranges::any_of(factors, is_pressure);
}

// Removes the factor sigma_n_MPa from a product.
Expr without_pressure(const Expr& e) {
  if (is_pressure(e)) return 1.0;
  const Expr &a = e.operands()[0], &b = e.operands()[1];
  if (e.op() == Op::divide) return without_pressure(a) / b;
  return has_pressure_factor(a) ? without_pressure(a) * b : a * without_pressure(b);
}

// A part of the formula that may become the piece, as a stress or as a coefficient.
struct Candidate {
  Expr part;              // a node of the formula
  bool is_mu;             // the piece is a coefficient
  bool times_pressure;    // `part` is sigma_n_MPa times the piece; false: it is the piece
  std::size_t states = 0; // number of states that the piece depends on
  std::size_t operations = 0;
};

class Splitter {
public:
  Splitter(const Expr& formula, const std::vector<Parameter>& parameters) {
    for (const Parameter& p : parameters)
      names_.insert(p.name);
    // A kink between parameters alone moves with no state; a kink on an axis gets a node.
    inside_out(formula, [this](const Expr& e) {
      bool kinked = false, moves = e.op() == Op::symbol && !names_.count(e.name());
      for (const Expr& operand : e.operands()) {
        kinked = kinked || kinked_.count(operand.id());
        moves = moves || moves_.count(operand.id());
      }
      if (moves) moves_.insert(e.id());
      if (kinked || (moves && is_kink(e.op()) && !place_on_axis(e))) kinked_.insert(e.id());
    });
  }

  // Collects candidates from the root of the formula inwards.
  void look(const Expr& e, bool is_mu) {
    const auto& a = e.operands();
    const bool kinked = kinked_.count(e.id()) > 0;
    if (kinked && (e.op() == Op::minimum || e.op() == Op::maximum || e.op() == Op::add ||
                   e.op() == Op::subtract || e.op() == Op::negate)) {
      for (const Expr& operand : a)
        look(operand, is_mu);
    } else if (kinked && e.op() == Op::where_le) {
      look(a[2], is_mu);
      look(a[3], is_mu);
    } else if (kinked && e.op() == Op::divide && !kinked_.count(a[1].id())) {
      look(a[0], is_mu);
    } else if (kinked && e.op() == Op::multiply &&
               kinked_.count(a[0].id()) != kinked_.count(a[1].id())) {
      const bool first = kinked_.count(a[0].id()) > 0;
      look(a[first ? 0 : 1], is_mu || has_pressure_factor(a[first ? 1 : 0]));
    } else {
      offer(e, is_mu);
    }
  }

  const Candidate& best() const {
    const auto rank = [](const Candidate& c) {
      return std::tuple(c.is_mu, c.states, c.operations);
    };
    return *std::ranges::max_element(found_, {}, rank);
  }

private:
  void offer(const Expr& e, bool is_mu) {
    const bool beside = !is_mu && has_pressure_factor(e);
    Candidate found{e, is_mu || beside, beside};
    const Expr piece = beside ? without_pressure(e) : e;
    for (const std::string& symbol : expr::symbols(piece))
      found.states += !names_.count(symbol);
    for_each_part(piece, [&](const Expr&) { ++found.operations; });
    found_.push_back(found);
  }

  std::set<std::string> names_;
  std::unordered_set<const Expr::Node*> moves_, kinked_; // nodes that contain a state, or a kink
  std::vector<Candidate> found_;
};

// ---- properties that a table uses ----

// Whether the structure of the formula guarantees positive values for every state.
bool is_positive(const Expr& formula, const std::vector<Parameter>& parameters) {
  std::unordered_set<const Expr::Node*> positive;
  const auto is = [&](const Expr& e) { return positive.count(e.id()) > 0; };
  const auto follows = [&](const Expr& e) { // from its operands
    const auto& a = e.operands();
    switch (e.op()) {
    case Op::constant:
      return e.value() > 0;
    case Op::symbol:
      return e.name() == "psi" || std::ranges::any_of(parameters, [&](const Parameter& p) {
               return p.name == e.name() && p.lower > 0;
             });
    case Op::exp:
      return true;
    case Op::sqrt:
    case Op::power:
      return is(a[0]);
    case Op::maximum:
      return is(a[0]) || is(a[1]);
    case Op::add:
    case Op::multiply:
    case Op::divide:
    case Op::minimum:
      return is(a[0]) && is(a[1]);
    default:
      return false;
    }
  };
  inside_out(formula, [&](const Expr& e) {
    if (follows(e)) positive.insert(e.id());
  });
  return is(formula);
}

// Whether a factor is a power or an exponential, so that ln of the product is nearly linear.
bool is_product(const Expr& e) {
  std::vector<Expr> factors;
  add_factors(e, factors);
  return std::ranges::any_of(factors, [](const Expr& factor) {
    return factor.op() == Op::exp || factor.op() == Op::power;
  });
}

std::map<std::string, std::vector<double>> kinks_of(const Expr& piece) {
  std::map<std::string, std::set<double>> found;
  for_each_part(piece, [&](const Expr& e) {
    if (const auto place = place_on_axis(e)) found[place->first].insert(place->second);
  });
  std::map<std::string, std::vector<double>> kinks;
  for (const auto& [name, values] : found)
    kinks[name] = {values.begin(), values.end()};
  return kinks;
}

// ---- names ----

// Returns the kind of thing that already has this name; empty if the name is free.
std::string taken_by(const std::string& name) {
  const std::string lower = lower_case(name);
  for (const data::Quantity& quantity : data::quantities())
    if (lower == lower_case(quantity.name)) return "a quantity";
  if (data::find_derived(lower)) return "a history";
  if (expr::is_function(lower)) return "a function";
  if (lower == "value") return "the piece, in `combine`";
  if (lower == lower_case(shear_yield_symbol)) return "the shear yield stress";
  if (lower == "pi") return "a number";
  if (lower == "m_limit" || is_effect_parameter(lower)) return "what tracing adds";
  return "";
}

// ---- the law ----

class LawReader {
public:
  LawReader(const LawText& text, FaultList& faults) : text_(text), faults_(faults) {}

  Law read() {
    const std::size_t before = faults_.size();
    law_.name = text_.name;
    law_.order = text_.order ? static_cast<int>(*text_.order) : order_of_user_laws;
    law_.title = text_.title.empty() ? "law of the user" : text_.title;
    law_.reference = text_.reference.empty() ? "the job file" : text_.reference;
    check_names();
    read_parameters();
    read_parts();
    const Formula whole = read_formulas();
    if (faults_.size() > before) return name_alone();
    const Expr tau = substitute(whole.combine, {{"value", whole.value}});
    if (!has_bearable_size(tau)) return name_alone();
    check_symbols(tau);
    if (faults_.size() > before) return name_alone();
    finish(whole);
    return std::move(law_);
  }

private:
  // Returns a placeholder, so that other checks of the job do not report the law as missing.
  Law name_alone() const {
    Law law;
    law.name = text_.name;
    return law;
  }

  void check_names() {
    std::set<std::string> seen; // in lower case, because Fortran ignores case
    const auto check = [&](const std::string& name, const Place& place, const char* noun) {
      if (!expr::is_name(name) || name.size() > longest_name)
        faults_.add(place, fmt::format("{} '{}' of law {} is not a name", noun, name, text_.name),
                    fmt::format("letters, digits and _, no digit first, at most {}", longest_name));
      else if (const std::string taken = taken_by(name); !taken.empty())
        faults_.add(
            place,
            fmt::format("{} '{}' of law {} has the name of {}", noun, name, text_.name, taken),
            "choose another name");
      else if (!seen.insert(lower_case(name)).second)
        faults_.add(place,
                    fmt::format("'{}' stands twice in law {}, apart from upper and lower case",
                                name, text_.name),
                    "choose another name: Fortran does not distinguish them");
    };
    for (const ParameterText& p : text_.parameters)
      check(p.name, p.place, "parameter");
    for (const auto& [name, formula] : text_.where)
      check(name, formula.place, "part");
  }

  void read_parameters() {
    const bool any_fitted =
        std::ranges::any_of(text_.parameters, [](const ParameterText& p) { return !p.value; });
    law_.calibrated = !any_fitted || text_.calibrated == "fixed" ? Calibrated::fixed
                      : text_.calibrated == "mean"               ? Calibrated::mean
                                                                 : Calibrated::fit;
    for (const ParameterText& p : text_.parameters) {
      if (p.value && (p.start || p.range))
        faults_.add(p.place,
                    fmt::format("parameter '{}' of law {} has a value and a start or a range",
                                p.name, text_.name),
                    "a value is a constant; leave it out where the parameter is calibrated");
      else if (p.value && any_fitted)
        add_constant(p.name, *p.value);
      else if (p.value)
        add_parameter(p, *p.value, *p.value, *p.value);
      else if (!p.range)
        faults_.add(p.place,
                    fmt::format("parameter '{}' of law {} has no range", p.name, text_.name),
                    "range = [0, 1] says where it is looked for; value = 0.08 that it is fixed");
      else if (p.start && (*p.start < p.range->first || *p.start > p.range->second))
        faults_.add(p.place,
                    fmt::format("parameter '{}' of law {} starts at {}, outside its range {} to {}",
                                p.name, text_.name, *p.start, p.range->first, p.range->second),
                    "leave the start out: it is then looked for over the range");
      else
        add_parameter(p, p.start.value_or(middle(*p.range)), p.range->first, p.range->second);
    }
  }

  void add_constant(const std::string& name, double value) {
    constants_.emplace(name, value);
    if (value > 0) // the name of a slip state contains its distance
      for (const auto& [family, rule] : data::slip_states())
        named_.emplace(family + name, Expr::symbol(data::slip_state_name(rule, value)));
  }

  static double middle(const std::pair<double, double>& range) {
    const bool decades = range.first > 0 && range.second > 100 * range.first;
    return decades ? std::sqrt(range.first * range.second) : 0.5 * (range.first + range.second);
  }

  void add_parameter(const ParameterText& p, double start, double lower, double upper) {
    law_.parameters.push_back({p.name, p.unit.empty() ? "1" : p.unit,
                               p.meaning.empty() ? "parameter of " + text_.name : p.meaning, start,
                               lower, upper, p.settled_by});
  }

  // Parses a formula and reports faults with their places in the job.
  Expr parse(const FormulaText& formula) {
    try {
      return expr::parse_expr(formula.text);
    } catch (const InputError& error) {
      for (const Fault& fault : error.faults())
        faults_.add(place_in(formula, fault.place.column), fault.what, fault.hint);
    }
    return 0.0;
  }

  // Returns the column within a formula of one line; for longer formulas the opening quote.
  static Place place_in(const FormulaText& formula, std::size_t column) {
    Place place = formula.place;
    if (place.column > 0 && formula.text.find('\n') == formula.text.npos) place.column += column;
    return place;
  }

  void read_parts() {
    for (const auto& [name, formula] : text_.where)
      named_.emplace(name, substitute(parse(formula), named_));
    for (const auto& [name, number] : constants_)
      named_.emplace(name, number);
    named_.emplace("pi", std::numbers::pi);
    for (auto& [name, part] : named_) // replaces constants
      part = substitute(part, named_);
  }

  Expr formula_of(const FormulaText& formula) { return substitute(parse(formula), named_); }

  Formula read_formulas() {
    const bool whole = !text_.formula.text.empty(), in_parts = !text_.piece.text.empty();
    if (whole == in_parts || (whole && !text_.combine.text.empty())) {
      faults_.add(text_.place,
                  whole ? fmt::format("law {} has a formula and parts of one", text_.name)
                        : fmt::format("law {} has no formula", text_.name),
                  "formula = \"...\" of tau_R in MPa, or piece = \"...\" with combine = \"...\"");
      return {};
    }
    if (whole) {
      if (!text_.quantity.empty())
        faults_.add(text_.place, fmt::format("law {} has a formula and a quantity", text_.name),
                    "the quantity is that of a `piece`");
      const Expr tau = shared(formula_of(text_.formula));
      if (!has_bearable_size(tau)) return {}; // the next steps visit shared parts repeatedly
      const Parts parts = parts_of(tau, law_.parameters);
      law_.quantity = parts.quantity;
      return parts.formula;
    }
    Formula formula{formula_of(text_.piece), text_.combine.text.empty()
                                                 ? state::value_times_pressure()
                                                 : formula_of(text_.combine)};
    const auto used = expr::symbols(formula.combine);
    if (!used.count("value"))
      faults_.add(text_.combine.place,
                  fmt::format("combine of law {} does not use `value`", text_.name),
                  "it says how tau_R follows from the piece: \"min(value*sigma_n_MPa, m*k_MPa)\"");
    const bool is_mu = text_.quantity.empty() ? used.count("sigma_n_MPa") > 0
                                              : text_.quantity == quantity_name(PieceQuantity::mu);
    law_.quantity = is_mu ? PieceQuantity::mu : PieceQuantity::tau_R;
    return formula;
  }

  // Limits the size after all named parts are inserted: short nested parts can expand to a huge
  // formula.
  bool has_bearable_size(const Expr& tau) {
    std::unordered_map<const Expr::Node*, double> terms; // number of terms when written out
    inside_out(tau, [&](const Expr& e) {
      double sum = 1;
      for (const Expr& operand : e.operands())
        sum += terms.at(operand.id());
      terms.emplace(e.id(), sum);
    });
    if (terms.at(tau.id()) <= expr::FormulaLimits::terms &&
        tau.depth() <= expr::FormulaLimits::depth)
      return true;
    faults_.add(
        text_.place,
        fmt::format("the formula of law {} is too large with its parts in place", text_.name),
        fmt::format("at most {} numbers, names and operations, {} within each other",
                    expr::FormulaLimits::terms, expr::FormulaLimits::depth));
    return false;
  }

  // Checks that each name is a parameter, a state, a history or a column, and that each parameter
  // is used.
  void check_symbols(const Expr& tau) {
    const auto used = expr::symbols(tau);
    std::set<std::string> parameters;
    for (const Parameter& p : law_.parameters)
      parameters.insert(p.name);
    std::set<std::string> distances; // parameters named within a state's name
    for (const std::string& name : used)
      if (const auto state = data::slip_state(name); state && !state->parameter.empty()) {
        distances.insert(state->parameter);
        check_distance(name, state->parameter);
      }
    if (distances.size() > 1)
      faults_.add(
          text_.place,
          fmt::format("law {} has states over {}", text_.name,
                      join(std::vector<std::string>(distances.begin(), distances.end()), " and ")),
          "all states of a law have one distance");
    for (const ParameterText& p : text_.parameters)
      if (!p.value && !used.count(p.name) && !distances.count(p.name))
        faults_.add(p.place,
                    fmt::format("law {} does not use its parameter '{}'", text_.name, p.name),
                    "leave it out, or use it in the formula");
    for (const std::string& name : used) {
      if (parameters.count(name) || name == shear_yield_symbol) continue;
      if (text_.order && name == flow_stress_symbol) continue;
      const data::Quantity* quantity = data::find_quantity(name);
      if (name == "value")
        faults_.add(place_of(name), fmt::format("law {} uses `value` outside combine", text_.name),
                    "`value` is the piece, and stands in `combine`");
      else if (quantity && !quantity->state)
        faults_.add(place_of(name),
                    fmt::format("law {} depends on {}, which is not a state of a contact",
                                text_.name, name),
                    "states: " + join(state_names(), ", "));
      else if (!quantity)
        law_.places.emplace(name, place_of(name)); // a column; data checks report a missing one
    }
    if (used.size() == parameters.size())
      faults_.add(text_.place, fmt::format("law {} depends on no state", text_.name),
                  "states: " + join(state_names(), ", "));
  }

  // Checks the distance within the name of a slip state: D_c of aging_state_over_D_c.
  void check_distance(const std::string& state, const std::string& distance) {
    const auto found = std::ranges::find(law_.parameters, distance, &Parameter::name);
    if (found == law_.parameters.end())
      faults_.add(place_of(state),
                  fmt::format("law {} has no parameter '{}' for {}", text_.name, distance, state),
                  "a parameter in mm, or a number as in aging_state_over_0p02mm");
    else if (!(found->lower > 0))
      faults_.add(text_.place,
                  fmt::format("the distance {} of law {} may be {}", distance, text_.name,
                              shortest(found->lower)),
                  "its range begins above 0");
  }

  static std::vector<std::string> state_names() {
    std::vector<std::string> names;
    for (const data::Quantity& quantity : data::quantities())
      if (quantity.state) names.push_back(quantity.name);
    return names;
  }

  // Returns the first place of a name in the texts of the formulas, or else the place of the law.
  Place place_of(const std::string& name) const {
    std::vector<const FormulaText*> formulas;
    for (const auto& [part, formula] : text_.where)
      formulas.push_back(&formula);
    for (const FormulaText* formula : {&text_.formula, &text_.piece, &text_.combine})
      formulas.push_back(formula);
    const auto is_part = [](char c) {
      return c == '_' || std::isalnum(static_cast<unsigned char>(c));
    };
    for (const FormulaText* formula : formulas)
      for (std::size_t at = formula->text.find(name); at != std::string::npos;
           at = formula->text.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at == 0 || !is_part(formula->text[at - 1])) &&
            (end == formula->text.size() || !is_part(formula->text[end])))
          return place_in(*formula, at + 1);
      }
    return text_.place;
  }

  void finish(const Formula& whole) {
    law_.formula = text_.people.empty() ? people_text() : text_.people;
    law_.log_value =
        text_.log_value || (is_product(whole.value) && is_positive(whole.value, law_.parameters));
    if (text_.nodes_at_kinks) law_.kinks = kinks_of(whole.value);
    for (const std::string& axis : text_.log_axes)
      law_.log_axes[axis] = true;
    law_.revisions = text_.revisions;
    law_.build = [whole, of_registry = text_.order.has_value()](const Conventions& conventions) {
      std::map<std::string, Expr> k = {{shear_yield_symbol, shear_yield_stress(conventions)}};
      if (of_registry) k.emplace(flow_stress_symbol, flow_stress_ratio(conventions.shear_yield));
      return Formula{substitute(whole.value, k), substitute(whole.combine, k)};
    };
    if (!text_.order) check_numbers(); // every law of the registry is tested
  }

  // Returns the formula as its author wrote it.
  std::string people_text() const {
    std::string out =
        text_.piece.text.empty()
            ? "tau_R = " + text_.formula.text
            : fmt::format("tau_R = {}; value = {}",
                          text_.combine.text.empty() ? "value*sigma_n_MPa" : text_.combine.text,
                          text_.piece.text);
    for (const auto& [name, formula] : text_.where)
      out += fmt::format("; {} = {}", name, formula.text);
    for (const auto& [name, number] : constants_)
      out += fmt::format("; {} = {}", name, shortest(number));
    std::ranges::replace(out, '\n', ' ');
    return out;
  }

  // Evaluates the law in the middle of the paper's Table 1 at the start values of its parameters.
  void check_numbers() {
    const Expr tau = tau_formula(law_, {});
    const std::vector<std::string> names = inputs_of(tau, law_);
    std::vector<double> row;
    std::string state;
    for (const std::string& name : names) {
      const data::Quantity* quantity = data::find_quantity(name);
      if (!quantity) return; // the range of a column is unknown
      const auto range = quantity->paper_range.value_or(std::pair(100.0, 1000.0));
      row.push_back(std::sqrt(range.first * range.second));
      state += fmt::format("{}{} = {:.4g}", state.empty() ? "" : ", ", name, row.back());
    }
    const double value =
        expr::Program(tau, names, parameter_names(law_))(row, start_values(law_.parameters));
    if (!std::isfinite(value))
      faults_.add(
          text_.place,
          fmt::format("law {} gives no number at {} and its start values", text_.name, state),
          "a logarithm or a root of something negative, or a division by 0?");
  }

  const LawText& text_;
  FaultList& faults_;
  Law law_;
  std::map<std::string, double> constants_; // parameters with a value in a law that is fitted
  std::map<std::string, Expr> named_;       // parts and constants
};

} // namespace

Parts parts_of(const Expr& tau_R, const std::vector<Parameter>& parameters) {
  Splitter splitter(tau_R, parameters);
  splitter.look(tau_R, false);
  const Candidate& best = splitter.best();
  const Expr piece = best.times_pressure ? without_pressure(best.part) : best.part;
  const Expr in_place = best.times_pressure ? state::value_times_pressure() : state::value();
  using Nodes = std::vector<std::pair<Expr, Expr>>;
  return {{piece, substitute(tau_R, Nodes{{best.part, in_place}})},
          best.is_mu ? PieceQuantity::mu : PieceQuantity::tau_R};
}

Law law_of_text(const LawText& text, FaultList& faults) {
  return LawReader(text, faults).read();
}

} // namespace frictab::models
