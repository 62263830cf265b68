// Writes formulas as MathML; Law::formula of a user's law is the text as it was written, which can
// be parsed.
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

std::string formula_html(const models::Law& law) {
  if (!models::is_registered(law) && law.base.empty())
    if (const auto set = as_mathml(law.formula)) return *set;
  return svg::escape(law.formula);
}

} // namespace frictab::report
