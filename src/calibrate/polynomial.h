// Calibration of the polynomial: orders by cross-validation over experiments, coefficients by
// generalised least squares, standard errors by experiment.
#pragma once

#include <string>
#include <vector>

#include "calibrate/polynomial_fit.h"
#include "data/dataset.h"
#include "models/law.h"

namespace frictab::calibrate {

struct PolynomialTerm {
  std::string text;       // "P2(z_v) z_T"; each z runs from -1 to 1 over the data
  double coefficient = 0; // of ln mu, which the term changes by at most this
  double std_error = 0;   // by experiment, with the ridge fixed
};

// Record of the fit; goes to calibration.json.
struct PolynomialRecord {
  std::vector<std::string> inputs;
  std::vector<std::string> coordinates; // of each input: "z_v = (ln(v_rel_mm_s) - 3.9)/2.3, ..."
  unsigned order = 0;                   // highest one with a share
  std::vector<double> cv_mae_MPa;       // on the bins of left-out experiments, per order from 1
  std::vector<double> shares;           // weights of the orders in the law
  std::size_t bins = 0;                 // fitted to
  std::size_t experiments = 0;          // with bins
  PolynomialNoise noise;                // of ln mu, for the fit of that order
  std::vector<double> spread;           // of its coefficients of order 1, 2, 3
  std::vector<PolynomialTerm> terms;    // by size of the coefficient
};

// "order 2, 20 terms".
std::string polynomial_size(const PolynomialRecord& record);

struct FittedPolynomial {
  models::Law law; // its own formula; parameter mu0
  double mu0 = 0;
  double mu0_error = 0;               // by experiment; NaN if not known
  std::vector<double> held_out_gains; // per experiment with bins, by the fit without it
  std::vector<std::string> remarks;   // on omitted rows and bins
  std::size_t evaluations = 0;        // of the restricted likelihood
  PolynomialRecord record;
};

// Fits orders 1, 2 and 3, and predicts every experiment from the others with each; scatter and
// ridge of an order are estimated once, from all experiments. The share of an order is the
// frequency with which it has the least mean absolute error of tau_R in resampled experiments
// (weights by the certainty of a choice: Buckland, Burnham and Augustin 1997), and the coefficients
// are averaged by these shares, because the choice of a single order would depend on the scatter of
// few experiments. The result depends on data and seed, not on the number of threads. With fewer
// than three experiments that have a friction coefficient, it is Coulomb's law.
FittedPolynomial regress_polynomial(const models::Law& law, const data::Dataset& training,
                                    const models::Conventions& conventions, std::uint64_t seed);

} // namespace frictab::calibrate
