// Predictions, Jacobians and noise-weighted fits of a law, with or without effects, on the blocks
// of a campaign.
//
// The trace stage fits hundreds of laws, so it fits them to block means (some 40 per experiment)
// instead of rows. A fit minimises
//   |V^-1/2 (measured - tau(p))|^2 + p' S p
// within the bounds of the parameters p, by Levenberg-Marquardt (stats/levenberg_marquardt.h). V is
// the noise model's covariance (noise.h), S the roughness matrix of smooth effects times their
// stiffness.
#pragma once

#include <memory>

#include "expr/program.h"
#include "models/law.h"
#include "stats/noise.h"
#include "trace/basics.h"
#include "trace/columns/candidates.h"

namespace frictab::trace {

class LawOnBlocks {
public:
  // smooth_MPa: min(a, b) in the law becomes (a + b - sqrt((a - b)^2 + smooth_MPa^2))/2 where it
  // depends on parameters (0: unchanged). With the kink, the derivative by a limit is 0 in every
  // row below that limit, and a fit would never move it. `columns` must outlive the object.
  LawOnBlocks(const models::Law& law, const models::Conventions& conventions,
              const BlockColumns& columns, double smooth_MPa = 0);

  const std::vector<models::Parameter>& parameters() const { return parameters_; }
  VectorXd predict(std::span<const double> parameters, MatrixXd* jacobian = nullptr) const;

private:
  std::vector<models::Parameter> parameters_;
  std::unique_ptr<expr::Program> program_;
  std::unique_ptr<expr::BoundProgram> bound_;
  Index count_;
};

struct BlockFit {
  std::vector<double> parameters;
  VectorXd predicted;
  MatrixXd jacobian;
};

// Stopping rule of a fit.
struct FitEnd {
  double enough = 1e-11;       // the last step is one that reduces the cost by less than this share
  std::size_t most_steps = 60; // accepted or not
};

// Adds (p - centre)' matrix (p - centre) to the sum of squares. Empty matrix: no penalty; empty
// centre: 0.
struct Penalty {
  MatrixXd matrix;
  VectorXd centre;
};

// Runs the fit described above; `penalty`: S. Steps that make a positive stress non-positive are
// rejected: where tests scatter as a whole, a law without friction is only a few standard
// deviations off, and the fit could go there.
BlockFit fit_blocks(const LawOnBlocks& law, const VectorXd& measured,
                    const stats::Whitener& whitener, std::vector<double> start,
                    const Penalty& penalty = {}, FitEnd end = {});

} // namespace frictab::trace
