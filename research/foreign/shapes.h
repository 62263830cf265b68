// What the files of effects share.
#pragma once

#include "foreign/part.h"

namespace frictab::foreign {

const std::vector<EffectKind>& effects_of_states();
const std::vector<EffectKind>& effects_of_bystanders();

// Along every test on its own: f(first row, row behind the last, output).
template <class Along> Values by_test(const Part& part, Along along) {
  Values out(part.rows());
  for (std::size_t e = 0; e < part.tests(); ++e)
    along(part.first_row[e], part.first_row[e + 1], out);
  return out;
}

template <class Of> Values by_row(const Part& part, Of of) {
  Values out(part.rows());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = of(i);
  return out;
}

inline Values integral(const Part& part, const Values& of) {
  const Values& s = part.at("s_mm");
  return by_test(part, [&](std::size_t first, std::size_t end, Values& out) {
    for (std::size_t i = first + 1; i < end; ++i)
      out[i] = out[i - 1] + 0.5 * (of[i] + of[i - 1]) * (s[i] - s[i - 1]);
  });
}

// A level between the shares low and high of the training rows.
inline double somewhere(const Values& values, double low, double high, Random& random) {
  return quantile(values, random.uniform(low, high));
}

inline double sign(Random& random) {
  return random.below(2) == 0 ? -1 : 1;
}

} // namespace frictab::foreign
