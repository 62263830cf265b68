// Claims about campaigns that residual tracing is scored on: stress profiles.
#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "twin/twin.h"
#include "twin/twin_draft.h"

namespace frictab {
namespace {

using testing::HasSubstr;

TwinOptions small(const std::string& design = "v=5,500;points=110;validation=6") {
  TwinOptions options;
  options.seed = 1;
  options.design = parse_design(design, default_design(twin_set("D")));
  return options;
}

std::span<const double> column(const TwinPart& part, const char* name) {
  return part.data.values(name);
}

std::string fault_of(const TwinOptions& options) {
  try {
    make_twin(options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

TEST(TwinProfiles, VariedOnesTellHighestFromMeanAndMomentaryStress) {
  TwinOptions options = small();
  options.profile = "varied";
  const Twin twin = make_twin(options);
  const auto sigma = column(twin.training, "sigma_n_MPa");
  const auto& first = twin.training.data.first_row;
  std::set<std::size_t> places; // of the highest stress: start, middle and end of the stroke
  for (std::size_t e = 0; e + 1 < first.size(); ++e) {
    const auto rows = sigma.subspan(first[e], first[e + 1] - first[e]);
    const auto peak = std::max_element(rows.begin(), rows.end()) - rows.begin();
    places.insert(static_cast<std::size_t>(3 * peak) / rows.size());
    for (const double s : rows) {
      ASSERT_GE(s, 0.3 * 500);
      ASSERT_LE(s, 1.05 * 2005);
    }
  }
  EXPECT_EQ(places.size(), 3u);
}

TEST(TwinProfiles, ReplicatesDiffer) {
  TwinOptions options = small("p=1725;psi=20;v=50;T=20;replicates=12;points=50;validation=0");
  options.profile = "varied";
  const Twin twin = make_twin(options);
  std::set<double> last;
  for (std::size_t e = 1; e <= 12; ++e)
    last.insert(column(twin.training, "sigma_n_MPa")[50 * e - 1]);
  EXPECT_GE(last.size(), 3u);
}

TEST(TwinProfiles, UnknownOneIsNamed) {
  TwinOptions options = small();
  options.profile = "variid";
  EXPECT_THAT(fault_of(options), HasSubstr("unknown profile 'variid'\n  hint: did you mean"));
}

} // namespace
} // namespace frictab
