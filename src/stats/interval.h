// An interval of a quantity, mostly one of 95 % confidence.
#pragma once

namespace frictab::stats {

struct Interval {
  double low = 0;
  double high = 0;
};

} // namespace frictab::stats
