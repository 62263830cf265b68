// One regression for everything that a law may lack.
//
//   y = ln(measured / law) = G theta + sum of terms X_j b_j + noise
//
// y, G and X are the modes of tests (modes.h), so that what is constant within tests and what
// changes within them stand in one regression, each with its own noise: a variance for each class
// of modes. G is a constant and d ln(law)/d parameters, free: what recalibration could do is no
// effect. The coefficients b_j of a term (terms.h) are normal with mean 0; the standard deviations
// of its straight and of its bent columns are its size, in ln of friction, found by likelihood. So
// a term that says nothing has size 0, and a bent one takes as many degrees of freedom as it needs:
// a penalised mixed model (Wood 2017, chapters 4 and 6), fitted by restricted likelihood.
//
// Whatever is asked of the rows are products of columns, class by class: they are made once, and a
// fit costs the cube of the coefficients that are in it.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include <Eigen/Core>

#include "trace/modes.h"

namespace frictab::trace {

// Standard deviations of the coefficients of a term.
struct TermSize {
  double straight = 0, bent = 0;
};

struct JointTerm {
  Eigen::Index first = 0, straight = 0, count = 0; // columns; the straight ones in front
  // A ratio counts what it explains within tests alone: between them others imitate it.
  bool within = false;
};

// Rows are modes, the classes one behind the other.
struct JointData {
  Eigen::VectorXd response;
  Eigen::MatrixXd columns; // of the law, then of the terms
  Eigen::Index law = 0;
  std::vector<JointTerm> terms;
  std::array<Eigen::Index, mode_classes + 1> first{};
  std::vector<std::size_t> test;

  // Rows of the tests that are kept.
  JointData part(const std::vector<char>& keep_test) const;
  // Of some terms alone, numbered as they stand there.
  JointData with_terms(const std::vector<std::size_t>& some) const;
  // Every row times its own factor.
  JointData weighted(const Eigen::VectorXd& factor) const;
};

using ByClass = std::array<double, mode_classes>;

// All that a response has to say.
struct Moments {
  Eigen::MatrixXd along; // columns x classes: X' y
  ByClass squares{};     // y' y
};

struct JointFit {
  std::vector<std::size_t> terms;
  std::vector<TermSize> sizes;
  ByClass variance{};
  std::vector<Eigen::Index> columns; // that have a coefficient
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd inverse;   // of the normal equations
  ByClass squares{};         // that are left
  ByClass used{};            // degrees of freedom
  double log_likelihood = 0; // restricted

  bool has(std::size_t term) const;
};

class JointModel {
public:
  explicit JointModel(JointData data);

  const JointData& data() const { return data_; }
  std::vector<Moments> moments(const Eigen::MatrixXd& responses) const; // modes x responses
  const Moments& of_data() const { return of_data_; }
  Eigen::VectorXd residual(const JointFit& fit) const;

  // Coefficients at these sizes and variances.
  JointFit solve(const std::vector<std::size_t>& terms, const std::vector<TermSize>& sizes,
                 const ByClass& variance, const Moments& moments) const;
  // The same with the noise estimated, `rounds` times in turn; from the response's own size where
  // no variance is given (all 0).
  JointFit fit(const std::vector<std::size_t>& terms, const std::vector<TermSize>& sizes,
               const ByClass& variance, const Moments& moments, int rounds) const;
  // Each size again given the others, on a fine grid, then the noise.
  JointFit tuned(const JointFit& fit, const Moments& moments) const;

  // The likeliest size of a term beside a fit, and the gain of log likelihood over none, the noise
  // estimated with it: what a large effect explains is no noise to hide behind.
  struct Ratio {
    double value = 0;
    TermSize size;
  };
  std::vector<Ratio> ratios(const JointFit& fit, const Moments& moments,
                            const std::vector<std::size_t>& terms) const;
  // Of one term on a fine grid, by all that it explains.
  Ratio fine_ratio(const JointFit& fit, const Moments& moments, std::size_t term) const;
  // Responses x terms, gains alone. `responses`: modes x responses, beside the fit.
  Eigen::MatrixXd ratios_of(const JointFit& fit, const Eigen::MatrixXd& responses,
                            const std::vector<std::size_t>& terms) const;

  // Of the columns of a term in one class of modes.
  double squares(std::size_t term, std::size_t mode_class) const {
    return own_[term][mode_class].trace();
  }
  // Of a straight coefficient of a term, on average: alone, and beside the fit.
  struct Information {
    double alone = 0, beside = 0;
  };
  std::vector<Information> information(const JointFit& fit,
                                       const std::vector<std::size_t>& terms) const;

private:
  using Cross = std::array<Eigen::MatrixXd, mode_classes>; // all columns x those of a term

  const Cross& cross_of(Eigen::Index first, Eigen::Index count) const;
  std::vector<const Cross*> crosses_of(const JointFit& fit) const;
  template <class Take> void for_columns(const JointFit& fit, const Take& take) const;
  std::array<Eigen::MatrixXd, mode_classes> products_of(const JointFit& fit) const; // Z' Z
  ByClass weights(const JointFit& fit) const;
  ByClass estimated_noise(const JointFit& fit) const;
  // What is needed beside a fit: of it, of a term, and of what it leaves of a response (Z' r).
  struct Beside;
  struct OfTerm;
  using Left = std::array<Eigen::VectorXd, mode_classes>;
  Beside beside(const JointFit& fit) const;
  static ByClass counted(const Beside& beside, const JointTerm& term); // weights in a ratio
  OfTerm of_term(const Beside& beside, std::size_t term) const;
  Left left_along(const Beside& beside, const Moments& moments) const;
  template <class Grid>
  Ratio likeliest(const Beside& beside, const Left& left, const Moments& moments, std::size_t term,
                  ByClass weight, const Grid& grid) const;
  // X~' X~ by class, X~ the columns of a term less what those of the fit explain of them.
  std::array<Eigen::MatrixXd, mode_classes> own_products(const Beside& beside, const OfTerm& of,
                                                         std::size_t term) const;

  JointData data_;
  Moments of_data_;
  std::vector<std::array<Eigen::MatrixXd, mode_classes>> own_; // per term X_j' X_j
  mutable std::mutex mutex_;
  mutable std::map<Eigen::Index, std::unique_ptr<const Cross>> cross_;
};

} // namespace frictab::trace
