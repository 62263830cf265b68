// A friction law as a text: in a job file under [models.my_law], in a file of laws, or in
// templates/laws, which includes the laws of the registry. All of them are calibrated, proven,
// tabulated and exported in the same way.
//
// One formula of tau_R is split into the two parts of a Law (law.h). Kinks - min, max, where - are
// searched for from the root of the formula inwards, through sums, products and further kinks, as
// long as the enclosing operation gives a stress or a coefficient. Candidates for the tabulated
// piece are the parts at which this search ends. A coefficient is preferred to a stress, then the
// part that depends on most states, then the one with most operations. Everything else stays in
// `combine`, which is evaluated exactly. A piece that has the factor sigma_n_MPa is a coefficient.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "models/law.h"

namespace frictab::models {

struct ParameterText {
  std::string name;
  std::string unit = "1";
  std::string meaning;
  std::optional<double> start;                    // absent: middle of the range
  std::optional<std::pair<double, double>> range; // of the search
  std::optional<double> value;                    // a constant without start and range
  std::string settled_by;                         // as in Parameter; only in the registry
  Place place;
};

struct FormulaText {
  std::string text; // empty if absent
  Place place;      // of its opening quote
};

struct LawText {
  std::string name;
  std::string title, reference;
  FormulaText formula;        // of tau_R in MPa; or piece, with or without combine
  FormulaText piece, combine; // combine absent: value*sigma_n_MPa
  std::string quantity;       // of the piece: "mu" or "tau_R"; empty: by `combine`
  std::vector<std::pair<std::string, FormulaText>> where; // named parts; each may use earlier ones
  std::vector<ParameterText> parameters;
  std::string table;                 // file of a table (models/law_table.h), instead of formulas
  std::string interpolation;         // between the table's nodes
  std::vector<std::string> log_axes; // linear in ln x; with a formula only in the registry
  Place place;

  // Members that only the registry's texts use:
  std::optional<std::uint64_t> order; // in listings; absent: after the registry
  std::string people;         // the formula in the notation of papers; empty: the formulas above
  std::string calibrated;     // "fixed" or "mean"; empty: fitted
  bool log_value = false;     // true: regardless of the form of the formula
  bool nodes_at_kinks = true; // false: max() and min() act only outside of tables
  std::vector<std::string> revisions; // as in Law
};

// Position in listings of a law without an order.
constexpr int order_of_user_laws = 90;

// Builds a law from its text. Formulas may use parameters, named parts, states by their canonical
// names, k_MPa (the shear yield stress by the job's convention), pi, recorded columns by their
// names (with _ for characters other than letters and digits) and histories (data/derived.h).
// Functions: exp, ln, log (natural), sqrt, sin, tanh, atan, arccos, abs, sign, min, max and
// where(a <= b, x, y); powers are written **.
//
// Faults (an unknown function, an unused parameter, two meanings of one name, ...) are added with
// their places within the formulas; the law is then not usable.
Law law_of_text(const LawText& text, FaultList& faults);

// The two parts of a formula of tau_R, and the quantity of the piece.
struct Parts {
  Formula formula;
  PieceQuantity quantity;
};
Parts parts_of(const expr::Expr& tau_R, const std::vector<Parameter>& parameters);

} // namespace frictab::models
