// Rigid dies. A die is given by the signed depth of a point inside it and by the unit normal that
// points into it. Two shapes:
//   platen   the plane z = level, the material below; it moves down,
//   nozzle   the bore of an extrusion die, r = w(z): container of radius R0, from the level on a
//            cone of half angle a and length L, bearing of radius R1. With x = z - level,
//              w = R0 - tan(a) (ramp(x) - ramp(x - L)), ramp(x) = (x + sqrt(x^2 + c^2))/2,
//            which rounds the corners over a length c and has all derivatives: Newton's method
//            meets no kink. The depth (r - w)/sqrt(1 + w'^2) is the distance to first order.
#pragma once

#include <cmath>

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
    const S in = sqrt(x * x + rounding_ * rounding_);
    const S out = sqrt(past * past + rounding_ * rounding_);
    const S wall = radius_ - 0.5 * slope_ * (length_ + in - out); // x - past = length
    const S tilt = -0.5 * slope_ * (x / in - past / out), norm = sqrt(1.0 + tilt * tilt);
    return {(r - wall) / norm, 1.0 / norm, -tilt / norm};
  }

private:
  bool is_platen_ = true;
  double level_ = 0;
  double radius_ = 0, slope_ = 0, length_ = 0, rounding_ = 0;
};
