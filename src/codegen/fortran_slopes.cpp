// Writes the interpolation with its derivatives as statements, in the order of frictab_gradient.h
// and frictab_cubic_gradient.h.
#include <algorithm>

#include <fmt/format.h>

#include "codegen/fortran_interpolation.h"

namespace frictab::codegen::fortran {

namespace {

using Strings = std::vector<std::string>;

// Writes ft_corners_gradient_N, depth first. p and q: the two ends on the last axis; "a" and "b":
// the two sides of the axis before; p2a: the value along axes 2 and further, p2a3: its derivative
// by axis 3's weight.
class Fan {
public:
  Fan(const std::vector<long>& stride, Slopes& out) : stride_(stride), out_(out) {}

  void write(std::size_t axis, long offset, const std::string& side) {
    const std::size_t number = axis + 1;
    if (number + 1 == stride_.size()) {
      const long upper = offset + stride_[axis];
      mix(number, fmt::format("p{}{}", number, side), value(offset), value(upper));
      mix(number, fmt::format("q{}{}", number, side), value(offset + 1), value(upper + 1));
      return;
    }
    write(axis + 1, offset, "a");
    write(axis + 1, offset + stride_[axis], "b");
    for (const char* end : {"p", "q"}) {
      const std::string name = fmt::format("{}{}{}", end, number, side);
      const std::string a = fmt::format("{}{}a", end, number + 1);
      const std::string b = fmt::format("{}{}b", end, number + 1);
      mix(number, name, a, b);
      for (std::size_t by = number + 1; by < stride_.size(); ++by)
        line("{0}{4} = v{1}*{2}{4} + w{1}*{3}{4}", name, number, a, b, by);
    }
  }

private:
  static std::string value(long offset) {
    return offset == 0 ? "tv(at)" : fmt::format("tv(at+{})", offset);
  }
  template <class... T> void line(fmt::format_string<T...> text, T&&... values) {
    out_.steps.push_back(fmt::format(text, std::forward<T>(values)...));
  }
  void mix(std::size_t number, const std::string& name, const std::string& a,
           const std::string& b) {
    line("{0} = v{1}*{2} + w{1}*{3}", name, number, a, b);
    line("{0}{1} = {3} - {2}", name, number, a, b);
  }

  const std::vector<long>& stride_;
  Slopes& out_;
};

// Writes ft_sum_gradient_N: rr(1..4,0) is the remaining value on the last axis, rr(1..4,k) its
// derivative by axis k; a1, a2, ... accumulate it along the axes before.
class Bundle {
public:
  Bundle(const table::Table& table, const std::vector<long>& stride, Slopes& out)
      : table_(table), stride_(stride), out_(out) {}

  void write(std::size_t axis, const std::string& at) {
    const std::size_t number = axis + 1, support = std::min<std::size_t>(nodes(axis), 4);
    if (number == stride_.size()) return each({fmt::format("rr(l,0) = tv({}+l-1)", at)});
    if (number + 1 == stride_.size()) {
      Strings lines;
      for (const std::string& weight : {std::string("w"), std::string("sl")})
        rows(axis, at, weight, weight == "w" ? 0 : number, lines);
      return each(lines);
    }
    each(columns(number, "a{0}(l,{1}) = 0.0D0"));
    out_.steps.push_back(fmt::format("do j{} = 0, {}", number, support - 1));
    out_.steps.push_back(fmt::format("i{0} = {1} + j{0}*{2}", number, at, stride_[axis]));
    write(axis + 1, fmt::format("i{}", number));
    Strings lines = columns(number, "a{0}(l,{1}) = a{0}(l,{1}) + w(j{0}+1,{0})*rr(l,{1})");
    lines[1] = fmt::format("a{0}(l,{0}) = a{0}(l,{0}) + sl(j{0}+1,{0})*rr(l,0)", number);
    each(lines);
    out_.steps.push_back("end do");
    each(columns(number, "rr(l,{1}) = a{0}(l,{1})"));
  }

private:
  std::size_t nodes(std::size_t axis) const { return table_.axes[axis].nodes.size(); }

  void each(const Strings& lines) {
    out_.steps.push_back("do l = 1, 4");
    out_.steps.insert(out_.steps.end(), lines.begin(), lines.end());
    out_.steps.push_back("end do");
  }

  // Returns the column of the value, then those of the axes from this one to the last but one.
  Strings columns(std::size_t number, const char* text) const {
    Strings out{fmt::format(fmt::runtime(text), number, 0)};
    for (std::size_t by = number; by < stride_.size(); ++by)
      out.push_back(fmt::format(fmt::runtime(text), number, by));
    return out;
  }

  // Writes ft_rows, with the weights `weight` of this axis, into rr(l,column).
  void rows(std::size_t axis, const std::string& at, const std::string& weight, std::size_t column,
            Strings& out) const {
    const std::size_t n = nodes(axis);
    const std::string to = fmt::format("rr(l,{})", column);
    const auto term = [&](long j) {
      return fmt::format("{}({},{})*tv({}+l{:+})", weight, j + 1, axis + 1, at,
                         j * stride_[axis] - 1);
    };
    out.push_back(fmt::format("{} = {} + {}", to, term(0), term(1)));
    if (n == 3) out.push_back(fmt::format("{0} = {0} + {1}", to, term(2)));
    if (n > 3) out.push_back(fmt::format("{0} = {0} + ({1} + {2})", to, term(2), term(3)));
  }

  const table::Table& table_;
  const std::vector<long>& stride_;
  Slopes& out_;
};

// Writes ft_dot4.
std::string dot(const std::string& weight, std::size_t axis, std::size_t column) {
  return fmt::format("({0}(1,{1})*rr(1,{2}) + {0}(2,{1})*rr(2,{2})) + "
                     "({0}(3,{1})*rr(3,{2}) + {0}(4,{1})*rr(4,{2}))",
                     weight, axis, column);
}

void name_slopes(std::size_t axes, Slopes& out) {
  for (std::size_t d = 1; d <= axes; ++d) {
    out.names.push_back(fmt::format("double precision g{}", d));
    out.names.push_back(fmt::format("integer(8) k{}", d));
  }
}

} // namespace

Slopes linear_slopes(const std::vector<long>& stride) {
  Slopes out;
  const std::size_t axes = stride.size();
  name_slopes(axes, out);
  for (std::size_t d = 1; d < axes; ++d)
    for (const char* side : {"a", "b"}) {
      if (d == 1 && *side == 'b') continue;
      for (std::size_t by = d; by < axes; ++by)
        out.names.push_back(fmt::format("double precision p{0}{1}{2}, q{0}{1}{2}", d, side, by));
    }
  const bool one = axes == 1;
  if (!one) Fan(stride, out).write(0, 0, "a");
  const std::string p = one ? "tv(at)" : "p1a", q = one ? "tv(at+1)" : "q1a";
  for (std::size_t by = 1; by < axes; ++by)
    out.steps.push_back(fmt::format("du({1}) = (v{0}*p1a{1} + w{0}*q1a{1})*g{1}", axes, by));
  out.steps.push_back(fmt::format("du({0}) = ({2} - {1})*g{0}", axes, p, q));
  out.steps.push_back(fmt::format("val = v{0}*{1} + w{0}*{2}", axes, p, q));
  return out;
}

Slopes cubic_slopes(const table::Table& table, const std::vector<long>& stride) {
  Slopes out;
  const std::size_t axes = stride.size();
  name_slopes(axes, out);
  for (std::size_t d = 1; d <= axes; ++d)
    out.names.push_back(fmt::format("double precision t{}", d));
  out.names.push_back(fmt::format("double precision sl(4,{}), rr(4,0:{})", axes, axes - 1));
  for (std::size_t d = 1; d + 2 <= axes; ++d)
    out.names.push_back(fmt::format("double precision a{}(4,0:{})", d, axes - 1));
  Bundle(table, stride, out).write(0, "at");
  for (std::size_t by = 1; by < axes; ++by)
    out.steps.push_back(fmt::format("du({}) = {}", by, dot("w", axes, by)));
  out.steps.push_back(fmt::format("du({}) = {}", axes, dot("sl", axes, 0)));
  out.steps.push_back("val = " + dot("w", axes, 0));
  return out;
}

} // namespace frictab::codegen::fortran
