// One regression for everything that a law may lack:
//
//   y = ln(measured / law) = G theta + sum of terms X_j b_j + noise
//
// y, G and X are expressed in the modes of tests (modes.h). Structure between tests and within
// tests is therefore estimated in one regression, each with its own noise: one variance per class
// of modes. G holds a constant and d ln(law)/d parameters; its coefficients are unpenalised,
// because structure that recalibration could remove is not an effect. The coefficients b_j of a
// term (terms.h) are normal with mean 0. The standard deviations of its straight and of its bent
// columns are its size, in ln of friction, and are estimated by likelihood. A term without
// information thus has size 0, and a bent one takes as many degrees of freedom as it needs: a
// penalised mixed model (Wood 2017, chapters 4 and 6), fitted by restricted likelihood.
//
// All sums over rows are products of columns, class by class. They are computed once, so a fit
// costs only the cube of its number of coefficients.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "trace/basics.h"
#include "trace/search/modes.h"

namespace frictab::trace {

// Standard deviations of the coefficients of a term.
struct TermSize {
  double straight = 0, bent = 0;
};

// A term of a fit.
struct SizedTerm {
  std::size_t term = 0;
  TermSize size;
};

struct JointTerm {
  Index first = 0, straight = 0, count = 0; // columns; the straight ones first
  // The likelihood ratio counts only the explained structure within tests, because other columns
  // imitate the term between tests.
  bool within = false;
};

struct JointFit;

// Response and columns of the regression. Rows are modes, sorted by class.
struct JointData {
  VectorXd response;
  MatrixXd columns; // the law's, then the terms'
  Index law = 0;
  std::vector<JointTerm> terms;
  std::array<Index, mode_classes + 1> first{};
  std::vector<std::size_t> test;

  // Number of modes of a class.
  Index count(std::size_t mode_class) const { return first[mode_class + 1] - first[mode_class]; }
  // Keeps only the rows of some tests.
  JointData part(const std::vector<char>& keep_test) const;
  // Keeps only some terms, renumbered in that order.
  JointData with_terms(const std::vector<SizedTerm>& some) const;
  // Multiplies every row by its own factor.
  JointData weighted(const VectorXd& factor) const;
  VectorXd residual(const JointFit& fit) const;
};

using ByClass = std::array<double, mode_classes>;

// Sufficient statistics of a response.
struct Moments {
  MatrixXd along;    // columns x classes: X' y
  ByClass squares{}; // y' y
};

struct JointFit {
  std::vector<SizedTerm> terms;
  ByClass variance{};
  std::vector<Index> columns; // those with a coefficient
  VectorXd coefficients;
  MatrixXd inverse;          // of the matrix of the normal equations
  ByClass squares{};         // residual sums of squares
  ByClass used{};            // degrees of freedom spent
  double log_likelihood = 0; // restricted

  // Terms without one of them; all if it is not in.
  std::vector<SizedTerm> terms_without(std::size_t term) const;
  bool has(std::size_t term) const;
};

class JointModel {
public:
  explicit JointModel(JointData data);

  const JointData& data() const { return data_; }
  // of responses: modes x responses
  std::vector<Moments> moments(const MatrixXd& responses) const;
  const Moments& of_data() const { return of_data_; }

  // Estimates coefficients at given sizes and variances.
  JointFit solve(const std::vector<SizedTerm>& terms, const ByClass& variance,
                 const Moments& moments) const;
  // The same with the noise estimated, in `rounds` alternations, starting from `variance` or, where
  // that is 0, from the response's own mean square.
  JointFit fit(const std::vector<SizedTerm>& terms, const ByClass& variance, const Moments& moments,
               int rounds) const;
  // Re-estimates each size given the others on a fine grid, then the noise.
  JointFit tuned(JointFit fit, const Moments& moments) const;

  // Likeliest size of a term added to a fit, and the gain of log likelihood compared with size 0.
  // The noise is estimated with the term: otherwise a large effect would count as noise.
  struct Ratio {
    double value = 0;
    TermSize size;
  };
  std::vector<Ratio> ratios(const JointFit& fit, const Moments& moments,
                            const std::vector<std::size_t>& terms) const;
  // The same for one term on a fine grid, always counting structure between tests too.
  Ratio fine_ratio(const JointFit& fit, const Moments& moments, std::size_t term) const;
  // Gains alone, responses x terms. `responses`: modes x responses, residuals of the fit.
  MatrixXd ratios_of(const JointFit& fit, const MatrixXd& responses,
                     const std::vector<std::size_t>& terms) const;

  // Sum of squares of a term's columns in one class of modes.
  double squares(std::size_t term, std::size_t mode_class) const {
    return own_[term][mode_class].trace();
  }
  // Mean information about a straight coefficient of a term: with no other columns, and with those
  // of the fit.
  struct Information {
    double alone = 0, beside = 0;
  };
  std::vector<Information> information(const JointFit& fit,
                                       const std::vector<std::size_t>& terms) const;

private:
  using Cross = std::array<MatrixXd, mode_classes>; // all columns x those of a term

  const Cross& cross_of(Index first, Index count) const;
  // Products of all columns with one of a fit: the matrices, and the column of these.
  using CrossColumn = std::pair<const Cross*, Index>;
  std::vector<CrossColumn> columns_of(const JointFit& fit) const;
  Cross products_of(const JointFit& fit) const; // Z' Z
  ByClass weights(const JointFit& fit) const;
  ByClass estimated_noise(const JointFit& fit) const;
  // Intermediate results for adding terms to a fit: those of the fit, and of one term.
  struct Beside;
  struct OfTerm;
  Beside beside(const JointFit& fit) const;
  static ByClass counted(const Beside& beside, const JointTerm& term); // weights in a ratio
  OfTerm of_term(const Beside& beside, std::size_t term) const;
  template <class Grid>
  std::vector<Ratio> likeliest(const JointFit& fit, const Moments& moments,
                               const std::vector<std::size_t>& terms, bool counts_all,
                               const Grid& grid) const;

  JointData data_;
  Moments of_data_;
  std::vector<std::array<MatrixXd, mode_classes>> own_; // per term X_j' X_j
  mutable std::mutex mutex_;
  mutable std::map<Index, std::unique_ptr<const Cross>> cross_;
};

} // namespace frictab::trace
