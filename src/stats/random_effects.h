// Random-effects summary of one quantity over campaigns: how well does it transfer to the next
// campaign?
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "stats/interval.h"

namespace frictab::stats {

// A campaign's estimate y = mu + u + e, with u the deviation of its true value, variance tau^2, and
// e its error, variance std_error^2.
struct Estimate {
  double value = 0;
  double std_error = 0;     // > 0
  std::size_t group = 0;    // level of a factor
  std::size_t campaign = 0; // index of the campaign
};

struct RandomEffects {
  std::size_t campaigns = 0;
  double mean = 0;       // mu; in the unit of the values, as all below
  Interval interval;     // 95 % of mu; NaN for fewer than two campaigns
  double between_sd = 0; // tau; NaN for fewer than two
  // 95 % of the true value of a new campaign; NaN for fewer than three
  Interval predicted;
};

// Estimates tau^2 by restricted maximum likelihood (reml.h) with one mean per group (Viechtbauer
// 2005, J. Educ. Behav. Stat. 30, eq. 10 by Fisher scoring); 0 where the estimates scatter no more
// than their errors. NaN if all groups have a single estimate.
double between_variance(std::span<const Estimate> estimates);

// Summarizes all estimates as one group. The interval of mu is that of Hartung and Knapp (2001,
// Stat. Med. 20) with t of k-1, never narrower than with the factor 1; the prediction interval is
// that of Higgins, Thompson and Spiegelhalter (2009, J. R. Stat. Soc. A 172) with t of k-2.
RandomEffects random_effects(std::span<const Estimate> estimates);

// An estimate that deviates significantly from the others.
struct Outlier {
  Estimate estimate;
  RandomEffects others; // summary without the outlier
  double p_value = 1;   // two-sided, times the number of estimates (Bonferroni)
};

// Tests deleted residuals, t of k-2 (Viechtbauer and Cheung 2010, Res. Synth. Methods 1), of the
// 100 estimates furthest from the mean, and returns those with a p-value below 0.05. Needs four
// estimates.
std::vector<Outlier> outliers(std::span<const Estimate> estimates);

// 95 % interval of a share of campaigns (Wilson 1927).
Interval share_interval(std::size_t count, std::size_t of);

} // namespace frictab::stats
