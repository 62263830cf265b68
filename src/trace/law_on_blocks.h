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

// Levenberg-Marquardt on whitened residuals within the parameters' bounds. `use` (per block 0 or 1;
// empty: all) leaves experiments out.
BlockFit fit_blocks(const LawOnBlocks& law, const Eigen::VectorXd& measured,
                    const Whitener& whitener, std::vector<double> start,
                    const Eigen::VectorXd& use = {}, const std::vector<bool>& frozen = {});

} // namespace frictab
