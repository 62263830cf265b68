// Work in a child process: however it ends, this one goes on and is told.
#include "core/os/isolated.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace frictab::isolated_test {
namespace {

using os::ByteSink;
using os::ByteSource;
using os::ChildLimits;
using os::run_isolated;

bool take_all(ByteSource&) {
  return true;
}

TEST(Isolated, HandsOverWhatTheChildWrote) {
  std::string text;
  std::array<double, 3> values{};
  EXPECT_TRUE(run_isolated(
      {},
      [](ByteSink& out) {
        out.text("tau_R");
        out.doubles(std::array{1.5, 2.5, -0.0});
      },
      [&](ByteSource& in) { return in.text(text, 10) && in.doubles(values); }));
  EXPECT_EQ(text, "tau_R");
  EXPECT_EQ(values, (std::array{1.5, 2.5, -0.0}));
}

TEST(Isolated, SaysThatAChildCrashed) {
  EXPECT_FALSE(run_isolated(
      {}, [](ByteSink&) { std::abort(); }, take_all));
}

TEST(Isolated, EndsALoopThatHasNoEnd) {
  ChildLimits limits;
  limits.cpu_seconds = 1;
  volatile bool forever = true;
  EXPECT_FALSE(run_isolated(
      limits,
      [&](ByteSink&) {
        while (forever) {
        }
      },
      take_all));
}

TEST(Isolated, GivesTheChildNoMoreMemoryThanItsLimit) {
  const auto takes = [](std::size_t values) {
    ChildLimits limits;
    limits.memory_bytes = std::uint64_t{256} << 20;
    std::uint64_t taken = 0;
    return run_isolated(
        limits, [values](ByteSink& out) { out.number(std::vector<double>(values).size()); },
        [&taken](ByteSource& in) { return in.number(taken); });
  };
  EXPECT_TRUE(takes(std::size_t{1} << 20));
  EXPECT_FALSE(takes(std::size_t{1} << 26)); // 512 MiB
}

} // namespace
} // namespace frictab::isolated_test
