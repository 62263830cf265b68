// Polynomial arithmetic with truncation; truncated terms and rounding go into the error.
#include "proof/taylor_model.h"

#include <limits>
#include <set>
#include <stdexcept>
#include <unordered_map>

#include "core/wide.h"
#include "proof/taylor_functions.h"

namespace frictab::proof {

using expr::Bounds;
using expr::Expr;
using expr::Op;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

// Appends all exponents with the sum `total`, over the variables from `variable` on; earlier
// variables first.
void list(std::size_t variable, std::size_t variables, std::size_t total, Monomials::Exponents& one,
          std::vector<Monomials::Exponents>& all) {
  if (variable + 1 >= variables) {
    if (variables > 0) one[variable] = static_cast<std::uint8_t>(total);
    if (variables > 0 || total == 0) all.push_back(one);
    return;
  }
  for (std::size_t e = total + 1; e-- > 0;) {
    one[variable] = static_cast<std::uint8_t>(e);
    list(variable + 1, variables, total - e, one, all);
  }
  one[variable] = 0;
}

} // namespace

Monomials::Monomials(std::size_t variables, std::size_t degree)
    : variables_(variables), degree_(degree) {
  if (variables > most_variables) throw std::logic_error("too many variables");
  for (std::size_t total = 0; total <= degree; ++total) {
    Exponents one{};
    list(0, variables, total, one, exponents_);
    degree_of_.resize(exponents_.size(), static_cast<std::uint8_t>(total));
    size_to_.push_back(exponents_.size());
  }
  product_.resize(size());
  for (std::size_t i = 0; i < size(); ++i)
    for (std::size_t j = 0; j < size_to(degree - degree_of(i)); ++j) {
      Exponents sum{};
      for (std::size_t v = 0; v < variables; ++v)
        sum[v] = static_cast<std::uint8_t>(exponents(i)[v] + exponents(j)[v]);
      product_[i].push_back(static_cast<std::uint16_t>(find(sum)));
    }
  describe();
}

void Monomials::describe() {
  power_.assign(variables_, {});
  for (std::size_t i = 0; i < size(); ++i) {
    factor_.push_back(0);
    rest_.push_back(0);
    multinomial_.push_back(1);
    without_.push_back({});
    for (std::size_t v = 0; v < variables_; ++v) {
      Exponents other = exponents(i);
      other[v] = 0;
      without_[i][v] = static_cast<std::uint16_t>(find(other));
      if (exponents(i)[v] == 0) continue;
      if (without_[i][v] == 0) power_[v].push_back(i);
      other = exponents(i);
      --other[v];
      factor_[i] = v;
      rest_[i] = find(other);
      for (std::size_t k = 1; k <= exponents(i)[v]; ++k)
        multinomial_[i] /= static_cast<double>(k);
    }
    for (std::size_t k = 1; k <= degree_of(i); ++k)
      multinomial_[i] *= static_cast<double>(k);
  }
  for (auto& list : power_)
    list.insert(list.begin(), 0);
}

std::size_t Monomials::find(const Exponents& exponents) const {
  const auto found = std::ranges::find(exponents_, exponents);
  return static_cast<std::size_t>(found - exponents_.begin());
}

namespace {

// One polynomial of the work space.
struct Model {
  double* c;
  std::size_t& degree;
  double& error;
};

// Loops over coefficients that the compiler vectorises. Sums run in eight lanes on every processor,
// so that the bits are the same everywhere.
constexpr std::size_t lanes = 8;

double total(const double* lane) {
  return ((lane[0] + lane[4]) + (lane[1] + lane[5])) + ((lane[2] + lane[6]) + (lane[3] + lane[7]));
}

FRICTAB_WIDE double sum_abs(const double* c, std::size_t from, std::size_t to) {
  double sum[lanes] = {};
  std::size_t i = from;
  for (; i + lanes <= to; i += lanes)
    for (std::size_t l = 0; l < lanes; ++l)
      sum[l] += std::abs(c[i + l]);
  for (; i < to; ++i)
    sum[0] += std::abs(c[i]);
  return total(sum);
}

// out = a + factor b; returns the sum of its absolute values. `a` may be null.
FRICTAB_WIDE double combine(std::size_t n, const double* a, double factor, const double* b,
                            double* out) {
  double sum[lanes] = {};
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes)
    for (std::size_t l = 0; l < lanes; ++l) {
      const double x = (a ? a[i + l] : 0.0) + factor * b[i + l];
      out[i + l] = x;
      sum[l] += std::abs(x);
    }
  for (; i < n; ++i) {
    out[i] = (a ? a[i] : 0.0) + factor * b[i];
    sum[0] += std::abs(out[i]);
  }
  return total(sum);
}

class Arithmetic {
public:
  explicit Arithmetic(const Monomials& monomials) : m_(monomials) {}

  Bounds range(const Model& a) const {
    const double spread = sum_abs(a.c, 1, m_.size_to(a.degree)) + a.error;
    return expr::outward(a.c[0] - spread, a.c[0] + spread);
  }
  bool is_number(const Model& a) const { return a.degree == 0 && a.error == 0; }

  void constant(double value, const Model& out) const {
    out.c[0] = value;
    out.degree = 0;
    out.error = 0;
  }
  void variable(std::size_t v, const Bounds& x, const Model& out) const {
    const double middle = 0.5 * (x.low + x.high), radius = 0.5 * x.width();
    std::fill(out.c, out.c + m_.size_to(std::min<std::size_t>(1, m_.degree())), 0.0);
    out.c[0] = middle;
    out.c[1 + v] = radius;
    out.degree = 1;
    out.error = eps * (std::abs(middle) + radius);
  }
  void copy(const Model& a, const Model& out) const {
    std::copy(a.c, a.c + m_.size_to(a.degree), out.c);
    out.degree = a.degree;
    out.error = a.error;
  }
  // a + factor b, with factor 1 or -1
  void add(const Model& a, const Model& b, double factor, const Model& out) const {
    const std::size_t na = m_.size_to(a.degree), nb = m_.size_to(b.degree);
    double sum = combine(std::min(na, nb), a.c, factor, b.c, out.c);
    if (na > nb) {
      std::copy(a.c + nb, a.c + na, out.c + nb);
      sum += sum_abs(a.c, nb, na);
    } else if (nb > na) {
      sum += combine(nb - na, nullptr, factor, b.c + na, out.c + na);
    }
    out.degree = std::max(a.degree, b.degree);
    out.error = a.error + b.error + eps * sum;
  }
  void scale(const Model& a, double factor, const Model& out) const {
    const double sum = combine(m_.size_to(a.degree), nullptr, factor, a.c, out.c);
    out.degree = a.degree;
    out.error = std::abs(factor) * a.error + eps * sum;
  }
  void shift(const Bounds& by, const Model& a) const {
    const double middle = 0.5 * (by.low + by.high);
    a.c[0] += middle;
    a.error += 0.5 * by.width() + eps * (std::abs(a.c[0]) + std::abs(middle));
  }
  // Moves terms of a degree above `limit` into the error.
  void multiply(const Model& a, const Model& b, std::size_t limit, const Model& out) const;
  void multiply(const Model& a, const Model& b, const Model& out) const {
    multiply(a, b, m_.degree(), out);
  }
  void substitute(std::size_t variable, const Model& by, const Model& spare, const Model& part,
                  const Model& a) const;
  void compose(Op op, const Model& a, const Model& y, const Model& spare, const Model& out) const;

private:
  const Monomials& m_;
  mutable double zero_ = 0;
};

// out may not be a or b.
void Arithmetic::multiply(const Model& a, const Model& b, std::size_t limit,
                          const Model& out) const {
  if (is_number(a) && b.degree <= limit) return scale(b, a.c[0], out);
  if (is_number(b) && a.degree <= limit) return scale(a, b.c[0], out);
  out.degree = std::min(limit, a.degree + b.degree);
  std::fill(out.c, out.c + m_.size_to(out.degree), 0.0);
  const std::size_t terms = m_.size_to(std::min(a.degree, limit));
  for (std::size_t i = 0; i < terms; ++i) {
    const double ai = a.c[i];
    if (ai == 0) continue;
    const std::uint16_t* to = m_.products(i);
    const std::size_t count = m_.size_to(std::min(b.degree, limit - m_.degree_of(i)));
    for (std::size_t j = 0; j < count; ++j)
      out.c[to[j]] += ai * b.c[j];
  }
  double by_degree[2][32] = {}, norm[2] = {};
  for (int k = 0; k < 2; ++k) {
    const Model& x = k == 0 ? a : b;
    for (std::size_t d = 0; d <= x.degree; ++d)
      norm[k] += by_degree[k][d] = sum_abs(x.c, d == 0 ? 0 : m_.size_to(d - 1), m_.size_to(d));
  }
  double cut = 0;
  for (std::size_t d = 0; d <= a.degree; ++d)
    for (std::size_t e = d > limit ? 0 : limit - d + 1; e <= b.degree; ++e)
      cut += by_degree[0][d] * by_degree[1][e];
  const double rounding =
      eps * static_cast<double>(std::min(terms, m_.size_to(b.degree)) + 1) * norm[0] * norm[1];
  out.error = a.error * norm[1] + b.error * norm[0] + a.error * b.error + (cut + rounding) * 1.0001;
}

// Replaces `variable` in a by a polynomial in that variable only, by Horner's rule; |by| <= 1.
void Arithmetic::substitute(std::size_t variable, const Model& by, const Model& spare,
                            const Model& part, const Model& a) const {
  const std::size_t n = m_.degree(), size = m_.size_to(a.degree);
  double slope = 0;
  for (std::size_t i = 0; i < size; ++i)
    slope += m_.exponents(i)[variable] * std::abs(a.c[i]);
  const double error = a.error + slope * by.error;
  constant(0, part);
  for (std::size_t k = n + 1; k-- > 0;) {
    multiply(part, {by.c, by.degree, zero_}, n, spare);
    std::fill(spare.c + m_.size_to(spare.degree), spare.c + m_.size(), 0.0);
    for (std::size_t i = 0; i < size; ++i)
      if (m_.exponents(i)[variable] == k) spare.c[m_.without(i, variable)] += a.c[i];
    spare.degree = n;
    copy(spare, part);
  }
  copy(part, a);
  a.error += error;
}

// op(a) as a polynomial in y = (a - its constant term) / radius.
void Arithmetic::compose(Op op, const Model& a, const Model& y, const Model& spare,
                         const Model& out) const {
  const double centre = a.c[0];
  const double spread = sum_abs(a.c, 1, m_.size_to(a.degree)) + a.error;
  const double radius = std::max(spread * (1 + 1e-12), 1e-30 * (1 + std::abs(centre)));
  double c[32];
  const std::size_t n = m_.degree() + 1;
  const double error = chebyshev_fit(op, centre, radius, {c, n});
  if (!std::isfinite(error)) {
    constant(0, out);
    out.error = HUGE_VAL;
    return;
  }
  scale(a, 1 / radius, y);
  y.c[0] = 0;
  if (y.degree <= 1) { // y^k by the multinomial theorem
    double slope = 0, size = 0;
    spare.c[0] = 1;
    out.c[0] = c[0];
    out.degree = y.degree == 0 ? 0 : m_.degree();
    for (std::size_t i = 1; i < m_.size_to(out.degree); ++i) {
      spare.c[i] = spare.c[m_.rest(i)] * y.c[1 + m_.factor(i)];
      out.c[i] = c[m_.degree_of(i)] * m_.multinomial(i) * spare.c[i];
      size += std::abs(out.c[i]);
    }
    for (std::size_t k = 1; k < n; ++k)
      slope += static_cast<double>(k) * std::abs(c[k]);
    out.error = error + slope * y.error + 16 * eps * (size + std::abs(c[0]));
    return;
  }
  // Horner's rule: a product that is multiplied by y k more times is needed only to degree() - k.
  constant(c[n - 1], out);
  for (std::size_t k = n - 1; k-- > 0;) {
    multiply(out, y, m_.degree() - k, spare);
    copy(spare, out);
    out.c[0] += c[k];
    out.error += eps * std::abs(out.c[0]);
  }
  out.error += error;
}

} // namespace

TaylorProgram::TaylorProgram(const Expr& formula, const std::vector<std::string>& columns,
                             const Monomials& monomials)
    : monomials_(monomials) {
  std::unordered_map<const Expr::Node*, std::size_t> done;
  expr::inside_out(formula, [&](const Expr& e) {
    Step step{.op = e.op()};
    if (e.op() == Op::constant) step.value = e.value();
    if (e.op() == Op::symbol) {
      const auto column = std::ranges::find(columns, e.name());
      if (column == columns.end())
        throw std::logic_error("formula has the unknown symbol '" + e.name() + "'");
      step.symbol = static_cast<std::size_t>(column - columns.begin());
    }
    for (const Expr& operand : e.operands())
      step.a[step.operands++] = done.at(operand.id());
    steps_.push_back(step);
    done.emplace(e.id(), steps_.size() - 1);
  });
  find_changes();
}

// The step of which step i is an affine function, ignoring constants.
std::size_t TaylorProgram::affine_source(std::size_t i) const {
  const Step& step = steps_[i];
  const auto is_constant = [&](std::size_t k) { return steps_[step.a[k]].op == Op::constant; };
  const bool sum = step.op == Op::add || step.op == Op::subtract || step.op == Op::multiply;
  if (step.op == Op::negate) return affine_source(step.a[0]);
  if (sum && is_constant(0)) return affine_source(step.a[1]);
  if ((sum || step.op == Op::divide) && is_constant(1)) return affine_source(step.a[0]);
  return i;
}

// Finds variables that reach the rest of the formula through one step only (Step::changes).
void TaylorProgram::find_changes() {
  std::vector<std::uint32_t> on(steps_.size(), 0); // bit set of variables
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (steps_[i].op == Op::symbol) on[i] = 1u << steps_[i].symbol;
    for (std::size_t k = 0; k < steps_[i].operands; ++k)
      on[i] |= on[steps_[i].a[k]];
  }
  for (std::size_t v = 0; v < monomials_.variables(); ++v) {
    std::set<std::size_t> ways;
    for (std::size_t i = 0; i < steps_.size(); ++i)
      for (std::size_t k = 0; k < steps_[i].operands; ++k)
        if (on[steps_[i].a[k]] == 1u << v && on[i] != 1u << v)
          ways.insert(affine_source(steps_[i].a[k]));
    if (ways.size() == 1 && steps_[*ways.begin()].op != Op::symbol)
      steps_[*ways.begin()].changes = v;
  }
}

// Number of spare models: three for intermediate results, and one per change of variable.
std::size_t TaylorProgram::Work::spares(const TaylorProgram& program) {
  return 3 + program.monomials_.variables();
}

TaylorProgram::Work::Work(const TaylorProgram& program)
    : storage_((program.steps_.size() + spares(program)) * program.monomials_.size()),
      degree_(program.steps_.size() + spares(program)),
      error_(program.steps_.size() + spares(program)) {}

// One evaluation over one box.
class TaylorProgram::Run {
public:
  Run(const TaylorProgram& program, Work& work)
      : program_(program), work_(work), with_(program.monomials_), t1_(model(0, 1)),
        t2_(model(1, 1)), t3_(model(2, 1)) {}

  Model model(std::size_t i, int spare = 0) const {
    if (spare) i += program_.steps_.size();
    return {work_.storage_.data() + i * program_.monomials_.size(), work_.degree_[i],
            work_.error_[i]};
  }

  void operator()(std::span<const Bounds> box) {
    for (std::size_t i = 0; i < program_.steps_.size(); ++i) {
      step(i, box);
      if (program_.steps_[i].changes != no_variable) change_variable(i);
    }
    const Model last = model(program_.steps_.size() - 1);
    for (const std::size_t v : changed_)
      if (!unknown(last)) with_.substitute(v, model(3 + v, 1), t1_, t2_, last);
  }

private:
  // Makes the result of this step the new variable, rescaled to -1 .. 1.
  void change_variable(std::size_t i) {
    const Model a = model(i);
    const std::size_t v = program_.steps_[i].changes;
    if (unknown(a) || a.degree <= 1) return;
    const Model kept = model(3 + v, 1);
    const double centre = a.c[0];
    const double radius =
        (sum_abs(a.c, 1, program_.monomials_.size_to(a.degree)) + a.error) * (1 + 1e-12);
    if (!(radius > 0)) return;
    with_.scale(a, 1 / radius, kept);
    kept.c[0] = 0;
    changed_.push_back(v);
    with_.variable(v, {centre - radius, centre + radius}, a);
  }

  void step(std::size_t i, std::span<const Bounds> box) {
    const Step& step = program_.steps_[i];
    const Model out = model(i), a = model(step.a[0]), b = model(step.a[1]);
    if (step.op == Op::constant) return with_.constant(step.value, out);
    if (step.op == Op::symbol) return with_.variable(step.symbol, box[step.symbol], out);
    if (unknown(a) || (step.operands > 1 && unknown(b))) return give_up(out);
    switch (step.op) {
    case Op::negate:
      return with_.scale(a, -1, out);
    case Op::add:
      return with_.add(a, b, 1, out);
    case Op::subtract:
      return with_.add(a, b, -1, out);
    case Op::multiply:
      return with_.multiply(a, b, out);
    case Op::divide:
      with_.compose(Op::divide, b, t1_, t2_, t3_);
      return unknown(t3_) ? give_up(out) : with_.multiply(a, t3_, out);
    case Op::minimum:
    case Op::maximum:
      return extreme(step.op == Op::maximum, a, b, out);
    case Op::where_le:
      return branch(a, b, model(step.a[2]), model(step.a[3]), out);
    default:
      return with_.compose(step.op, a, t1_, t2_, out);
    }
  }

  static bool unknown(const Model& a) { return !std::isfinite(a.error); }

  void give_up(const Model& out) const {
    with_.constant(0, out);
    out.error = HUGE_VAL;
  }

  // Copies one operand, enlarged by the possible contribution of the other.
  void take_operand(const Model& one, const Bounds& more, const Model& out) const {
    if (unknown(one) || !more.finite()) return give_up(out);
    with_.copy(one, out);
    if (more.low != 0 || more.high != 0) with_.shift(more, out);
  }

  // max(a, b) = a + max(b - a, 0) = b + max(a - b, 0), likewise for min; takes the form that adds
  // less.
  void extreme(bool largest, const Model& a, const Model& b, const Model& out) const {
    with_.add(b, a, -1, t1_);
    const Bounds d = with_.range(t1_);
    if (largest ? d.high <= 0 : d.low >= 0) return take_operand(a, {0, 0}, out);
    if (largest ? d.low >= 0 : d.high <= 0) return take_operand(b, {0, 0}, out);
    if (largest)
      return d.high < -d.low ? take_operand(a, {0, d.high}, out)
                             : take_operand(b, {0, -d.low}, out);
    return -d.low < d.high ? take_operand(a, {d.low, 0}, out) : take_operand(b, {-d.high, 0}, out);
  }

  void branch(const Model& a, const Model& b, const Model& x, const Model& y,
              const Model& out) const {
    with_.add(a, b, -1, t1_);
    const Bounds beyond = with_.range(t1_);
    if (beyond.high <= 0) return take_operand(x, {0, 0}, out);
    if (beyond.low > 0) return take_operand(y, {0, 0}, out);
    if (unknown(x) || unknown(y)) return give_up(out);
    with_.add(y, x, -1, t1_);
    take_operand(x, expr::hull({0, 0}, with_.range(t1_)), out);
  }

  const TaylorProgram& program_;
  Work& work_;
  const Arithmetic with_;
  const Model t1_, t2_, t3_;
  std::vector<std::size_t> changed_; // changed variables
};

double TaylorProgram::operator()(std::span<const Bounds> box, Work& work,
                                 std::span<double> polynomial) const {
  Run run(*this, work);
  run(box);
  const Model last = run.model(steps_.size() - 1);
  std::ranges::fill(polynomial, 0.0);
  std::copy(last.c, last.c + monomials_.size_to(last.degree), polynomial.begin());
  return last.error;
}

} // namespace frictab::proof
