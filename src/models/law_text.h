// A friction law as a text: of a job file's [models.my_law], a file of laws, or templates/laws,
// which has those of the registry too. Whoever wrote it, it is calibrated, proven, tabulated,
// exported.
//
// From one formula of tau_R follow the two parts that a Law has (law.h). Kinks - min, max, where -
// are looked for from the outside in, as long as what holds them is a stress or a coefficient:
// sums, products, further kinks. What lies below is smooth. The smooth part that depends on most
// states becomes the piece that a table holds; everything else stays in `combine`, which is
// evaluated exactly. Where a factor sigma_n_MPa stands in front of the piece, the piece is a
// coefficient.
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
  std::optional<double> start;                    // absent: the middle of the range
  std::optional<std::pair<double, double>> range; // of the search
  std::optional<double> value;                    // a constant: neither start nor range
  std::string settled_by;                         // as Parameter has it; registry alone
  Place place;
};

struct FormulaText {
  std::string text; // empty: not given
  Place place;      // of its opening quote
};

struct LawText {
  std::string name;
  std::string title, reference;
  FormulaText formula;        // of tau_R in MPa; or piece, with or without combine
  FormulaText piece, combine; // combine absent: value*sigma_n_MPa
  std::string quantity;       // of the piece: "mu" or "tau_R"; empty: by `combine`
  std::vector<std::pair<std::string, FormulaText>> where; // named parts, each of those before it
  std::vector<ParameterText> parameters;
  std::string table;         // instead of all formulas: the file of a table (models/law_table.h)
  std::string interpolation; // between its nodes
  std::vector<std::string> log_axes; // straight in ln x; of a formula: registry alone
  Place place;

  // Of the registry's texts alone.
  std::optional<std::uint64_t> order; // in listings; absent: behind the registry, as written
  std::string people;                 // the formula as people write it; empty: as above
  std::string calibrated;             // "fixed" or "mean"; empty: fitted
  bool log_value = false;             // whatever the formula looks like
  bool nodes_at_kinks = true;         // false: max() and min() bound what no table reaches
  std::vector<std::string> revisions; // as Law has them
};

// The place in listings of a law without an order.
constexpr int order_of_user_laws = 90;

// In formulas stand parameters, named parts, states by their canonical names, k_MPa (the shear
// yield stress by the job's convention), pi, and columns that the data record, by their names
// (signs that are no letter or digit as _) or histories (data/derived.h). Functions: exp, ln, log
// (natural), sqrt, sin, tanh, atan, arccos, abs, sign, min, max, where(a <= b, x, y); powers are
// written **.
//
// Faults (an unknown function, an unused parameter, two meanings of one name, ...) are added with
// their places within the formulas; then the law is of no use.
Law law_of_text(const LawText& text, FaultList& faults);

// A formula of tau_R in its two parts; the quantity of the piece.
struct Parts {
  Formula formula;
  PieceQuantity quantity;
};
Parts parts_of(const expr::Expr& tau_R, const std::vector<Parameter>& parameters);

} // namespace frictab::models
