// Tensor and simplex polynomials in Chebyshev form.
#include "proof/cell_polynomial.h"

#include <array>
#include <cmath>
#include <numbers>

#include "table/spline.h"

namespace frictab::proof {

using table::SplineAxis;
using table::Table;
using table::TableAxis;

namespace {

constexpr std::size_t npos = static_cast<std::size_t>(-1);

// x^k = sum of chebyshev(k, m) T_m(x): 2^(1-k) binomial(k, (k-m)/2), half of it for m = 0.
double chebyshev(std::size_t k, std::size_t m) {
  if (m > k || (k - m) % 2) return 0;
  double binomial = 1;
  for (std::size_t i = 0; i < (k - m) / 2; ++i)
    binomial = binomial * static_cast<double>(k - i) / static_cast<double>(i + 1);
  return std::ldexp(m == 0 ? binomial : 2 * binomial, -static_cast<int>(k));
}

double binomial(std::size_t n, std::size_t k) {
  double out = 1;
  for (std::size_t i = 0; i < k; ++i)
    out = out * static_cast<double>(n - i) / static_cast<double>(i + 1);
  return out;
}

} // namespace

CellPolynomials::CellPolynomials(const Table& table)
    : support_(table.interpolation == table::Interpolation::cubic ? 4 : 2) {
  std::vector<SplineAxis> splines;
  for (const TableAxis& axis : table.axes) {
    Axis out{axis.nodes.size(), {}, {}};
    if (support_ == 4) {
      splines.push_back(table::spline_axis(axis));
      out.first = splines.back().first;
      out.basis = splines.back().basis;
    } else {
      for (std::size_t i = 0; i + 1 < axis.nodes.size(); ++i) {
        out.first.push_back(static_cast<int>(i));
        out.basis.insert(out.basis.end(), {1, 0, -1, 1});
      }
    }
    axes_.push_back(std::move(out));
  }
  coefficients_ = table.value_coordinates();
  if (support_ == 4) coefficients_ = table::spline_coefficients(splines, coefficients_);
  stride_.assign(axes_.size(), 1);
  for (std::size_t a = axes_.size(); a-- > 1;)
    stride_[a - 1] = stride_[a] * axes_[a].nodes;
}

void CellPolynomials::over(std::span<const CellPart> box, std::vector<double>& tensor) const {
  std::size_t base = 0, count = 1;
  std::vector<std::array<double, 16>> matrix(axes_.size()); // [Chebyshev][coefficient]
  for (std::size_t a = 0; a < axes_.size(); ++a) {
    const CellPart& part = box[a];
    const double* b = axes_[a].basis.data() + support_ * support_ * part.cell;
    const double middle = 0.5 * (part.low + part.high), radius = 0.5 * (part.high - part.low);
    matrix[a].fill(0);
    for (std::size_t power = 0; power < support_; ++power)
      for (std::size_t j = 0; j <= power; ++j) { // t^power = (middle + radius x)^power
        double factor = binomial(power, j);
        for (std::size_t k = 0; k < power; ++k)
          factor *= k < j ? radius : middle;
        for (std::size_t m = 0; m <= j; ++m)
          for (std::size_t coefficient = 0; coefficient < support_; ++coefficient)
            matrix[a][m * support_ + coefficient] +=
                chebyshev(j, m) * factor * b[power * support_ + coefficient];
      }
    base += static_cast<std::size_t>(axes_[a].first[part.cell]) * stride_[a];
    count *= support_;
  }
  tensor.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t at = base, rest = i;
    bool there = true;
    for (std::size_t a = axes_.size(); a-- > 0; rest /= support_) {
      const std::size_t coefficient = rest % support_;
      there =
          there && coefficient < axes_[a].nodes; // an axis of 2 or 3 nodes has no more coefficients
      at += coefficient * stride_[a];
    }
    tensor[i] = there ? coefficients_[at] : 0;
  }
  std::size_t inner = count;
  for (std::size_t a = 0; a < axes_.size(); ++a) {
    inner /= support_;
    const std::size_t outer = count / (inner * support_);
    for (std::size_t o = 0; o < outer; ++o)
      for (std::size_t i = 0; i < inner; ++i) {
        double x[4];
        double* at = tensor.data() + o * inner * support_ + i;
        for (std::size_t t = 0; t < support_; ++t)
          x[t] = at[t * inner];
        for (std::size_t m = 0; m < support_; ++m) {
          double sum = 0;
          for (std::size_t t = 0; t < support_; ++t)
            sum += matrix[a][m * support_ + t] * x[t];
          at[m * inner] = sum;
        }
      }
  }
}

Rewriting::Rewriting(const Monomials& monomials) : size_(monomials.size()) {
  const std::size_t n = monomials.variables();
  chebyshev_.resize(n);
  lower_.resize(n);
  upper_.resize(n);
  for (std::size_t i = 0; i < size_; ++i)
    for (std::size_t v = 0; v < n; ++v) {
      const std::size_t k = monomials.exponents(i)[v];
      for (std::size_t m = 0; m <= k; ++m) {
        Monomials::Exponents to = monomials.exponents(i);
        to[v] = static_cast<std::uint8_t>(m);
        const auto from_index = static_cast<std::uint16_t>(i);
        const auto to_index = static_cast<std::uint16_t>(monomials.find(to));
        if (chebyshev(k, m) != 0) chebyshev_[v].push_back({from_index, to_index, chebyshev(k, m)});
        const double share = std::ldexp(binomial(k, m), -static_cast<int>(k)); // x = (y +- 1)/2
        upper_[v].push_back({from_index, to_index, share});
        lower_[v].push_back({from_index, to_index, (k - m) % 2 ? -share : share});
      }
    }
}

void Rewriting::apply(const Terms& terms, std::span<double> c) const {
  std::vector<double> out(size_, 0.0);
  for (const Term& term : terms)
    out[term.to] += term.factor * c[term.from];
  std::ranges::copy(out, c.begin());
}

void Rewriting::to_chebyshev(std::span<double> c) const {
  for (const Terms& terms : chebyshev_)
    apply(terms, c);
}

void Rewriting::halve(std::size_t variable, bool upper, std::span<double> c) const {
  apply(upper ? upper_[variable] : lower_[variable], c);
}

Deviation::Deviation(const Monomials& monomials, std::size_t support)
    : variables_(monomials.variables()), degree_(std::max(monomials.degree(), support - 1)),
      support_(support) {
  std::size_t count = 1;
  for (std::size_t v = 0; v < variables_; ++v)
    count *= support;
  used_.assign(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t rest = i;
    for (std::size_t v = variables_; v-- > 0; rest /= support)
      if (rest % support) used_[i] |= 1u << v;
  }
  for (std::size_t i = 0; i < monomials.size(); ++i) {
    const auto& e = monomials.exponents(i);
    exponents_.push_back(e);
    std::size_t at = 0;
    std::uint32_t bits = 0;
    for (std::size_t v = 0; v < variables_; ++v) {
      if (e[v]) bits |= 1u << v;
      at = e[v] < support && at != npos ? at * support + e[v] : npos;
    }
    tensor_index_.push_back(at);
    used_by_.push_back(bits);
  }
}

namespace {

// Bounds the range of sum_k c[k] T_k(x), k >= 1, |x| <= 1. A polynomial of degree n exceeds its
// largest value at m + 1 points, evenly spaced in the angle, by a factor of at most 1/cos(n pi / (2
// m)) (Ehlich and Zeller 1964).
expr::Bounds range_of(std::span<const double> c) {
  double sum = 0;
  for (const double x : c)
    sum += std::abs(x);
  if (sum == 0) return {0, 0};
  constexpr std::size_t m = 48;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (std::size_t i = 0; i <= m; ++i) {
    const double x = std::cos(std::numbers::pi * static_cast<double>(i) / m);
    double before = 1, now = x, value = 0;
    for (const double one : c) {
      value += one * now;
      const double next = 2 * x * now - before;
      before = now;
      now = next;
    }
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const double factor =
      1 / std::cos(std::numbers::pi * static_cast<double>(c.size()) / (2.0 * m)) + 1e-12;
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low) * factor;
  return {std::max(-sum, middle - half), std::min(sum, middle + half)};
}

} // namespace

Deviation::Result Deviation::operator()(std::span<const double> c,
                                        std::vector<double>& tensor) const {
  std::vector<double> alone(variables_ * degree_, 0.0); // [variable][degree - 1]
  Result out{{0, 0}, std::vector<double>(variables_, 0.0)};
  double mixed = 0, rounding = 0;
  const auto add = [&](double x, std::uint32_t bits, std::size_t variable, std::size_t degree) {
    if (bits & (bits - 1)) { // more than one variable
      mixed += std::abs(x);
      for (std::size_t v = 0; v < variables_; ++v)
        if (bits >> v & 1) out.mixed[v] += std::abs(x);
    } else if (bits) {
      alone[variable * degree_ + degree - 1] += x;
    } else {
      out.range.low += x;
    }
  };
  const auto single = [](std::uint32_t bits) { // number of the variable
    std::size_t v = 0;
    while (bits > 1)
      bits >>= 1, ++v;
    return v;
  };
  for (std::size_t i = 0; i < c.size(); ++i) {
    rounding += std::abs(c[i]);
    if (tensor_index_[i] != npos) {
      tensor[tensor_index_[i]] -= c[i];
      continue;
    }
    const std::size_t v = single(used_by_[i]);
    add(c[i], used_by_[i], v, exponents_[i][v]);
  }
  for (std::size_t i = 0; i < tensor.size(); ++i) {
    const std::size_t v = single(used_[i]);
    std::size_t degree = i;
    for (std::size_t w = variables_; w-- > v + 1;)
      degree /= support_;
    add(-tensor[i], used_[i], v, degree % support_);
  }
  out.range.high = out.range.low;
  for (std::size_t v = 0; v < variables_; ++v) {
    const expr::Bounds one = range_of({alone.data() + v * degree_, degree_});
    out.range.low += one.low;
    out.range.high += one.high;
  }
  if (variables_ > 0) mixed += 1e-13 * rounding; // rounding of the coefficients of both polynomials
  out.range.low -= mixed;
  out.range.high += mixed;
  return out;
}

} // namespace frictab::proof
