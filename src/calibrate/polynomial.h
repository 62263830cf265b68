// Calibrates the polynomial: its orders by cross-validation over experiments, its coefficients by
// generalised least squares, their errors by experiment.
#pragma once

#include <string>
#include <vector>

#include "calibrate/polynomial_fit.h"
#include "data/dataset.h"
#include "models/law.h"

namespace frictab::calibrate {

struct PolynomialTerm {
  std::string text;       // "P2(z_v) z_T"; of z from -1 to 1 over the data
  double coefficient = 0; // of ln mu: the term moves it by at most this
  double std_error = 0;   // by experiment, the ridge held
};

// What was tried and what came out; goes to calibration.json.
struct PolynomialRecord {
  std::vector<std::string> inputs;
  std::vector<std::string> coordinates; // of each input: "z_v = (ln(v_rel_mm_s) - 3.9)/2.3, ..."
  unsigned order = 0;                   // highest with a share
  std::vector<double> cv_mae_MPa;       // of the bins of left-out experiments, per order from 1
  std::vector<double> shares;           // of the orders in the law
  std::size_t bins = 0;                 // of rows, fitted to
  std::size_t experiments = 0;          // that have them
  PolynomialNoise noise;                // of ln mu, about the fit of that order
  std::vector<double> spread;           // of its coefficients of order 1, 2, 3
  std::vector<PolynomialTerm> terms;    // by size of the coefficient
};

// "order 2, 20 terms".
std::string polynomial_size(const PolynomialRecord& record);

struct FittedPolynomial {
  models::Law law; // its own formula; parameter mu0
  double mu0 = 0;
  double mu0_error = 0;               // by experiment; NaN where it is not known
  std::vector<double> held_out_gains; // per experiment with bins, by the fit without it
  std::vector<std::string> remarks;   // what was left out
  std::size_t evaluations = 0;        // of the restricted likelihood
  PolynomialRecord record;
};

// Order 1, 2 and 3 are fitted, and each predicts every experiment from the others; scatter and
// ridge of an order are estimated once, from all. An order's share is how often it has the least
// mean absolute error of tau_R where experiments are drawn again (weights by how sure a choice is:
// Buckland, Burnham and Augustin 1997), and the coefficients are averaged by these shares: a choice
// of one order alone is decided by the scatter of few experiments. Depends on data and seed, not on
// the number of threads. Where fewer than three experiments have a coefficient at all, it is
// Coulomb's law.
FittedPolynomial regress_polynomial(const models::Law& law, const data::Dataset& training,
                                    const models::Conventions& conventions, std::uint64_t seed);

} // namespace frictab::calibrate
