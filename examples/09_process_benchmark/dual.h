// Numbers that carry their derivatives (forward differentiation). A Dual<N> is a value a together
// with its N partial derivatives a_i; the rules of the calculus are the operators:
//   (a b)_i = a_i b + a b_i,   (a/b)_i = (a_i - (a/b) b_i)/b,   f(a)_i = f'(a) a_i.
// A function that is written once for any type of number then gives stresses with double, and with
// Dual its exact tangent for Newton's method: no tangent is derived by hand, none can disagree with
// its stress. (Griewank, Walther: Evaluating Derivatives, SIAM 2008, chapter 3.)
#pragma once

#include <array>
#include <cmath>

template <int N> struct Dual {
  double value = 0;
  std::array<double, N> d{};

  Dual() = default;
  Dual(double constant) : value(constant) {}
  // The number i of the N that are differentiated by.
  static Dual variable(double value, int i) {
    Dual x(value);
    x.d[static_cast<unsigned>(i)] = 1;
    return x;
  }
  // f(a) from its value and its derivative by a.
  Dual chain(double f, double slope) const {
    Dual y(f);
    for (unsigned i = 0; i < N; ++i)
      y.d[i] = slope * d[i];
    return y;
  }
  Dual& operator+=(const Dual& b) {
    value += b.value;
    for (unsigned i = 0; i < N; ++i)
      d[i] += b.d[i];
    return *this;
  }
  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(const Dual& a) { return a.chain(-a.value, -1); }
  friend Dual operator-(const Dual& a, const Dual& b) {
    Dual y(a.value - b.value);
    for (unsigned i = 0; i < N; ++i)
      y.d[i] = a.d[i] - b.d[i];
    return y;
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual y(a.value * b.value);
    for (unsigned i = 0; i < N; ++i)
      y.d[i] = a.d[i] * b.value + a.value * b.d[i];
    return y;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    Dual y(a.value / b.value);
    for (unsigned i = 0; i < N; ++i)
      y.d[i] = (a.d[i] - y.value * b.d[i]) / b.value;
    return y;
  }
  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return a.chain(root, 0.5 / root);
  }
  friend Dual log(const Dual& a) { return a.chain(std::log(a.value), 1 / a.value); }
};

inline double value_of(double x) {
  return x;
}
template <int N> double value_of(const Dual<N>& x) {
  return x.value;
}

// f(x) for a function of which value and slope are known.
inline double chain(double, double f, double) {
  return f;
}
template <int N> Dual<N> chain(const Dual<N>& x, double f, double slope) {
  return x.chain(f, slope);
}
