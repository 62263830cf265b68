// Writes formulas as MathML: of a user's law and of traced effects from Law::formula, the text as
// it was written; of registered laws from the tree that is computed, because theirs is for people.
#include "report/formula.h"

#include <array>
#include <cctype>
#include <optional>

#include <fmt/format.h>

#include "core/error.h"
#include "data/quantity.h"
#include "expr/mathml.h"
#include "report/svg.h"

namespace frictab::report {

namespace {

// Returns the letter for its name in formulas.
std::string letter(const std::string& word) {
  static constexpr std::array<const char*, 12> greek = {"alpha", "beta",  "gamma",  "delta",
                                                        "eta",   "theta", "lambda", "mu",
                                                        "psi",   "sigma", "tau",    "phi"};
  for (const char* name : greek)
    if (word == name) return fmt::format("<mi>&{};</mi>", name);
  return "<mi>" + svg::escape(word) + "</mi>";
}

// Writes sigma_n_MPa as sigma with the index N, mu0 as mu with the index 0, k_MPa as k.
std::string symbol(const std::string& name) {
  const data::Quantity* quantity = data::find_quantity(name);
  const std::string shown = quantity ? quantity->symbol : name == "k_MPa" ? "k" : name;
  std::size_t split = shown.find('_');
  const bool has_bar = split != shown.npos;
  if (!has_bar) {
    split = shown.size();
    while (split > 1 && std::isdigit(static_cast<unsigned char>(shown[split - 1])))
      --split;
  }
  const std::string index = split < shown.size() ? shown.substr(split + (has_bar ? 1 : 0)) : "";
  if (index.empty()) return letter(shown);
  return "<msub>" + letter(shown.substr(0, split)) + "<mi>" + svg::escape(index) + "</mi></msub>";
}

std::optional<std::string> as_mathml(const std::string& text) {
  std::string lines;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find("; ", at), text.size());
    const std::string one = text.substr(at, end - at);
    const std::size_t is = one.find(" = ");
    if (is == one.npos) return std::nullopt;
    try {
      lines += "<mtr><mtd>" + symbol(one.substr(0, is)) + "<mo>=</mo>" +
               expr::mathml(expr::parse_expr(one.substr(is + 3)), symbol) + "</mtd></mtr>";
    } catch (const InputError&) {
      return std::nullopt;
    }
    at = end + 2;
  }
  return "<math><mtable columnalign=\"left\">" + lines + "</mtable></math>";
}

} // namespace

namespace {

std::string equation(const std::string& left, const std::string& right) {
  return "<mtr><mtd>" + left + "<mo>=</mo>" + right + "</mtd></mtr>";
}

// The piece that tables sample, then tau_R made from it; nothing for formulas
// of trained laws, which no one reads.
std::optional<std::string> tree_as_mathml(const models::Model& model) {
  constexpr std::size_t most_parts = 80;
  const models::Law& law = *model.law;
  if (models::is_trained(law.calibrated) || !law.build) return std::nullopt;
  const models::Formula formula = law.build(model.conventions);
  std::size_t parts = 0;
  for (const expr::Expr& one : {formula.value, formula.combine})
    expr::for_each_part(one, [&](const expr::Expr&) { ++parts; });
  if (parts > most_parts) return std::nullopt;
  const bool is_mu = law.quantity == models::PieceQuantity::mu;
  const std::string piece = is_mu ? "<mi>&mu;</mi>" : "<mi>&tau;</mi>", tau = symbol("tau_R");
  const auto named = [&](const std::string& name) {
    return name == "value" ? piece : symbol(name);
  };
  const std::string value = expr::mathml(formula.value, named),
                    combine = expr::mathml(formula.combine, named);
  if (combine == piece) return "<math><mtable>" + equation(tau, value) + "</mtable></math>";
  return "<math><mtable columnalign=\"left\">" + equation(piece, value) + equation(tau, combine) +
         "</mtable></math>";
}

} // namespace

std::string formula_html(const models::Model& model) {
  const models::Law& law = *model.law;
  if (!models::is_registered(law) && law.base.empty())
    if (const auto set = as_mathml(law.formula)) return *set;
  if (const auto set = tree_as_mathml(model)) return *set;
  return svg::escape(law.formula);
}

} // namespace frictab::report
