// NI_Scale properties of a TDMS channel: how raw values become physical ones.
#pragma once

#include <string>
#include <vector>

#include "io/tdms_format.h"

namespace frictab::io::tdms {

// The chain of scales from the raw value to the last of NI_Number_Of_Scales; empty if
// NI_Scaling_Status is "scaled" or there are no scales. Each takes the result of an earlier one.
class Scales {
public:
  explicit Scales(const Properties& properties);

  bool empty() const { return steps_.empty(); }
  // Description of the first scale that is neither Linear nor Polynomial; else empty.
  const std::string& unreadable() const { return unreadable_; }
  void apply(std::vector<double>& values) const;

private:
  // Coefficients of a polynomial in ascending order.
  using Step = std::vector<double>;

  void add(const Properties& properties, const std::string& scale, const std::string& type);
  void add_polynomial(const Properties& properties, const std::string& scale);

  std::vector<Step> steps_; // the last one first
  std::string unreadable_;
};

} // namespace frictab::io::tdms
