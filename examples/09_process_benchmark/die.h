// Rigid dies. A die is given by the signed depth of a point inside it and by the unit normal that
// points into it. Two shapes:
//   platen   the plane z = level, the material below; it moves down,
//   nozzle   the bore of an extrusion die, r = w(z): container of radius R0, from the level on a
//            cone of half angle a and length L, bearing of radius R1. With x = z - level,
//              w = R0 - tan(a) (ramp(x) - ramp(x - L)),
//              ramp(x) = 0 below -c, (x + c)^3 (3 c - x)/(16 c^3) from -c to c, x above c,
//            which rounds the corners from -c to c and leaves container and bearing straight;
//            its second derivative is continuous: Newton's method meets no kink. The depth
//            (r - w)/sqrt(1 + w'^2) is the distance to first order.
#pragma once

#include <cmath>

#include "dual.h"

template <class S> struct DieContact {
  S depth;              // mm, positive inside the die
  S normal_r, normal_z; // unit vector into the die
};

class Die {
public:
  static Die platen(double level) {
    Die die;
    die.level_ = level;
    return die;
  }
  static Die nozzle(double level, double radius_in, double radius_out, double half_angle,
                    double rounding) {
    Die die;
    die.level_ = level;
    die.is_platen_ = false;
    die.radius_ = radius_in;
    die.slope_ = std::tan(half_angle);
    die.length_ = (radius_in - radius_out) / die.slope_;
    die.rounding_ = rounding;
    return die;
  }
  void move_to(double level) { level_ = level; }
  double level() const { return level_; }

  template <class S> DieContact<S> at(const S& r, const S& z) const {
    using std::sqrt;
    if (is_platen_) return {z - level_, S(0.0), S(1.0)};
    const S x = z - level_, past = x - length_;
    const S wall = radius_ - slope_ * (ramp(x) - ramp(past));
    const S tilt = -slope_ * (slope_of_ramp(x) - slope_of_ramp(past)); // w'
    const S norm = sqrt(1.0 + tilt * tilt);
    return {(r - wall) / norm, 1.0 / norm, -tilt / norm};
  }

private:
  template <class S> S ramp(const S& x) const {
    const double c = rounding_;
    if (value_of(x) <= -c) return S(0.0);
    if (value_of(x) >= c) return x;
    return (x + c) * (x + c) * (x + c) * (3 * c - x) / (16 * c * c * c);
  }
  template <class S> S slope_of_ramp(const S& x) const {
    const double c = rounding_;
    if (value_of(x) <= -c) return S(0.0);
    if (value_of(x) >= c) return S(1.0);
    return (x + c) * (x + c) * (2 * c - x) / (4 * c * c * c);
  }

  bool is_platen_ = true;
  double level_ = 0;
  double radius_ = 0, slope_ = 0, length_ = 0, rounding_ = 0;
};
