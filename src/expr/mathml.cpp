// Builds MathML bottom-up; each part carries its binding strength.
#include "expr/mathml.h"

#include <cmath>
#include <map>
#include <unordered_map>

#include <fmt/format.h>

namespace frictab::expr {

namespace {

// Binding strength of a part: a sum, a product, a factor with a sign, an atom.
enum class Binding { sum, product, sign, atom };

struct Part {
  std::string text;
  Binding binding = Binding::atom;
};

using Parts = std::unordered_map<const Expr::Node*, Part>;

std::string row(const std::string& text) {
  return "<mrow>" + text + "</mrow>";
}

std::string sign_text(const char* sign) {
  return std::string("<mo>") + sign + "</mo>";
}

std::string bracketed(const Part& part, Binding least) {
  return part.binding < least ? row(sign_text("(") + part.text + sign_text(")")) : row(part.text);
}

std::string call(const char* name, const std::string& arguments) {
  return fmt::format("<mi>{}</mi><mo>&#8289;</mo>{}", name,
                     row(sign_text("(") + arguments + sign_text(")")));
}

// Writes 1.5e-05 as 1.5 times a power of ten.
Part number_part(double value) {
  std::string text = fmt::format("{:.6g}", std::abs(value));
  if (const std::size_t at = text.find('e'); at != text.npos)
    text = fmt::format("<mn>{}</mn><mo>&#183;</mo><msup><mn>10</mn><mn>{}</mn></msup>",
                       text.substr(0, at), std::stoi(text.substr(at + 1)));
  else
    text = "<mn>" + text + "</mn>";
  if (std::signbit(value)) return {sign_text("&#8722;") + text, Binding::sign};
  return {text, text.starts_with("<mn>") && text.find("<mo>") == text.npos ? Binding::atom
                                                                           : Binding::product};
}

Part cases(const Part& a, const Part& b, const Part& x, const Part& y) {
  const auto line = [](const std::string& value, const std::string& when) {
    return "<mtr><mtd>" + row(value) + "</mtd><mtd>" + row(when) + "</mtd></mtr>";
  };
  return {row(sign_text("{") + "<mtable columnalign=\"left\">" +
              line(x.text, a.text + sign_text("&#8804;") + b.text) +
              line(y.text, "<mtext>else</mtext>") + "</mtable>"),
          Binding::atom};
}

Part part_of(const Expr& e, const std::function<std::string(const std::string&)>& symbol,
             const Parts& done) {
  const auto of = [&](std::size_t i) -> const Part& { return done.at(e.operands()[i].id()); };
  switch (e.op()) {
  case Op::constant:
    return number_part(e.value());
  case Op::symbol:
    return {symbol(e.name()), Binding::atom};
  case Op::negate:
    return {sign_text("&#8722;") + bracketed(of(0), Binding::product), Binding::sign};
  case Op::add:
    return {of(0).text + sign_text("+") + bracketed(of(1), Binding::product), Binding::sum};
  case Op::subtract:
    return {of(0).text + sign_text("&#8722;") + bracketed(of(1), Binding::product), Binding::sum};
  case Op::multiply:
    return {bracketed(of(0), Binding::product) + sign_text("&#8290;") +
                bracketed(of(1), Binding::atom),
            Binding::product};
  case Op::divide:
    return {"<mfrac>" + row(of(0).text) + row(of(1).text) + "</mfrac>", Binding::atom};
  case Op::power:
    return {"<msup>" + bracketed(of(0), Binding::atom) + row(of(1).text) + "</msup>",
            Binding::atom};
  case Op::sqrt:
    return {"<msqrt>" + row(of(0).text) + "</msqrt>", Binding::atom};
  case Op::where_le:
    return cases(of(0), of(1), of(2), of(3));
  default:
    break;
  }
  static const std::map<Op, const char*> names = {
      {Op::exp, "exp"},     {Op::log, "ln"},      {Op::sin, "sin"},    {Op::tanh, "tanh"},
      {Op::acos, "arccos"}, {Op::minimum, "min"}, {Op::maximum, "max"}};
  const bool one = e.operands().size() == 1;
  return {call(names.at(e.op()), one ? of(0).text : of(0).text + sign_text(",") + of(1).text),
          Binding::atom};
}

} // namespace

std::string mathml(const Expr& formula,
                   const std::function<std::string(const std::string&)>& symbol) {
  Parts done;
  inside_out(formula, [&](const Expr& e) { done.emplace(e.id(), part_of(e, symbol, done)); });
  return row(done.at(formula.id()).text);
}

} // namespace frictab::expr
