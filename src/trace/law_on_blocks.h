// A law, with or without effects, on the blocks of a campaign: predictions, Jacobians and fits
// weighted by the noise model.
#pragma once

#include <map>
#include <memory>
#include <string>

#include <Eigen/Core>

#include "expr/program.h"
#include "models/law.h"
#include "trace/noise.h"

namespace frictab {

// Block means by symbol: the law's inputs and every candidate column.
using BlockColumns = std::map<std::string, Eigen::VectorXd>;

class LawOnBlocks {
public:
  // smooth_MPa: width over which minima of the law are rounded off (0: none), so that a fit sees a
  // limit that it has not reached yet. `columns` must outlive the object.
  LawOnBlocks(const Law& law, const Conventions& conventions, const BlockColumns& columns,
              double smooth_MPa = 0);

  const std::vector<Parameter>& parameters() const { return parameters_; }
  Eigen::VectorXd predict(std::span<const double> parameters) const;
  Eigen::VectorXd predict(std::span<const double> parameters, Eigen::MatrixXd& jacobian) const;

private:
  std::vector<Parameter> parameters_;
  std::unique_ptr<Program> program_;
  std::unique_ptr<BoundProgram> bound_;
  Eigen::Index count_;
};

struct BlockFit {
  std::vector<double> parameters;
  Eigen::VectorXd predicted;
  Eigen::MatrixXd jacobian;
  double cost = 0; // sum of squared whitened residuals
};

// Levenberg-Marquardt on whitened residuals within the parameters' bounds. `penalty`: p' penalty p
// is added to the cost (of smooth effects; empty: none). `weight`: per block, behind the whitening
// (empty: 1). Done where a step gains less than `enough` of the cost. No block whose stress is
// positive at the start loses it.
// (Not calibrate's solver, with which parameters agree to five digits: how the folds of a search
// fit their noise follows the last ones, and with it the nested log score, by up to 3 %.)
BlockFit fit_blocks(const LawOnBlocks& law, const Eigen::VectorXd& measured,
                    const Whitener& whitener, std::vector<double> start,
                    const Eigen::MatrixXd& penalty = {}, const Eigen::VectorXd& weight = {},
                    double enough = 1e-11);

} // namespace frictab
