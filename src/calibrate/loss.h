// The three losses of a residual r in MPa: L2 r^2/2, Huber, and L1 smoothed to sqrt(r^2+eps^2).
#pragma once

#include <algorithm>
#include <cmath>

#include "calibrate/options.h"

namespace frictab::calibrate {

struct LossFunction {
  Loss kind = Loss::l2;
  double width_MPa = 10; // Huber: |r| at which it becomes linear; L1: eps, the smoothing width
  double kernel_MPa = 0; // L1: residuals within this distance of 0 estimate the curvature

  double cost(double r) const {
    if (kind == Loss::l2) return 0.5 * r * r;
    if (kind == Loss::l1) return std::sqrt(r * r + width_MPa * width_MPa);
    return std::abs(r) <= width_MPa ? 0.5 * r * r : width_MPa * (std::abs(r) - 0.5 * width_MPa);
  }
  // Weight of iteratively reweighted least squares: cost'(r)/r.
  double weight(double r) const {
    if (kind == Loss::l2) return 1;
    if (kind == Loss::l1) return 1 / std::sqrt(r * r + width_MPa * width_MPa);
    return std::abs(r) <= width_MPa ? 1 : width_MPa / std::abs(r);
  }
  // Curvature for standard errors. L1 has none of its own: the curvature of its mean is twice the
  // density of the residuals at 0, estimated by Epanechnikov's kernel.
  double curvature(double r) const {
    if (kind == Loss::l2) return 1;
    if (kind == Loss::huber) return std::abs(r) <= width_MPa ? 1 : 0;
    const double h = std::max(2 * width_MPa, kernel_MPa), x = r / h;
    return std::max(0.0, 1 - x * x) * 1.5 / h;
  }
  // Curvature used for steps: it includes a small part of the weight, so that steps stay short
  // where no row has any curvature.
  double step_curvature(double r) const {
    if (kind == Loss::l2) return 1;
    if (kind == Loss::l1) return curvature(r) + 0.02 * weight(r);
    return std::abs(r) <= width_MPa ? 1 : 0.1 * width_MPa / std::abs(r);
  }
};

} // namespace frictab::calibrate
