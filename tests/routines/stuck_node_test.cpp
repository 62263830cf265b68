// One node under penalty contact, driven through VFRIC and VFRICTION as Abaqus/Explicit does: the
// stick force is the friction force before, carried on by the penalty stiffness along the motion.
// And single increments of it, beside the table's own answer.
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "routines/abaqus_routines.h"

namespace frictab::stuck_node_test {

namespace {

constexpr double mass = 1e-6, stiffness = 7.5e5, time_step = 2e-7; // t, N/mm, s

template <class Case> class SlowPenaltyNode : public test::NeedsGfortran, protected Case {
protected:
  using Call = typename Case::Call;
  using Real = typename Case::Real;

  void SetUp() override {
    NeedsGfortran::SetUp();
    if (IsSkipped()) return;
    function_ = this->routine("stuck", test::four_axis());
    call_ = Case::call(1, [](Call& plain) {
      plain.directions = 2;
      plain.states = 6;
      plain.time_increment = static_cast<Real>(time_step);
    });
  }

  // One increment of central differences under this load.
  void advance(double load) {
    speed_ += (load + friction_) / mass * time_step;
    const double motion = speed_ * time_step, along = motion < 0 ? -1 : 1;
    moved_ += motion;
    call_.slip[0] = static_cast<Real>(std::abs(motion));
    call_.previous[0] = static_cast<Real>(friction_ * along);
    call_.stick[0] = static_cast<Real>(stiffness * std::abs(motion) - friction_ * along);
    call_.run(function_);
    friction_ = static_cast<double>(call_.tangential[0]) * along;
  }

  // After one increment at 50 mm/s.
  Call moved(double stick, double previous) {
    Call c = call_;
    c.slip[0] = static_cast<Real>(50 * time_step);
    c.stick[0] = static_cast<Real>(stick);
    c.previous[0] = static_cast<Real>(previous);
    const test::FloatTraps traps;
    c.run(function_);
    return c;
  }

  // Largest friction of a node that moves this fast, mm/s.
  double limit(double speed) { return Case::tau(1000, speed, 100); }

  double kept_slip() const { return static_cast<double>(call_.state[0] + call_.state[4]); }
  double kept_work() const { return static_cast<double>(call_.state[1] + call_.state[5]); }

  Call call_;
  void* function_ = nullptr;
  double speed_ = 0, moved_ = 0, friction_ = 0;
};

TYPED_TEST_SUITE(SlowPenaltyNode, test::ForceCases, test::RoutineName);

TYPED_TEST(SlowPenaltyNode, GivesTheStickForceWithItsSignAsFarAsFrictionHoldsIt) {
  const double limit = this->limit(50);
  EXPECT_EQ(this->moved(10, -10).tangential[0], -10);
  EXPECT_EQ(this->moved(0, 0).tangential[0], 0);
  EXPECT_EQ(this->moved(-5, 5).tangential[0], 5);
  EXPECT_NEAR(this->moved(1e30, 0).tangential[0], -limit, TestFixture::bound * limit);
  EXPECT_NEAR(this->moved(-1e30, 0).tangential[0], limit, TestFixture::bound * limit);
}

TYPED_TEST(SlowPenaltyNode, AForceBeforeThatIsNaNCountsAsTheOneNow) {
  const double limit = this->limit(50);
  const auto c = this->moved(1e30, std::numeric_limits<double>::quiet_NaN());
  EXPECT_NEAR(c.tangential[0], -limit, TestFixture::bound * limit);
  EXPECT_EQ(c.state[0], c.slip[0]);
  const double work = limit * static_cast<double>(c.slip[0]);
  EXPECT_NEAR(c.state[1], work, TestFixture::bound * work);
}

// Half of what friction holds, give or take 10 %, for 24,000 increments: the node moves back in
// every period, where the stick force turns against the motion.
TYPED_TEST(SlowPenaltyNode, StuckByHalfTheLimitStaysWithinTheElasticSlip) {
  const double mean = 0.5 * this->limit(0), elastic = mean / stiffness;
  double farthest = 0;
  for (int i = 0; i < 24000; ++i) {
    const double ramp = std::min(1.0, i / 2000.0);
    this->advance(ramp * mean * (1 + 0.1 * std::sin(2 * std::numbers::pi * i / 60)));
    farthest = std::max(farthest, std::abs(this->moved_));
  }
  EXPECT_LT(farthest, 1.25 * elastic);
  EXPECT_GT(farthest, elastic);
  EXPECT_EQ(this->kept_slip(), 0);
  EXPECT_EQ(this->kept_work(), 0);
}

TYPED_TEST(SlowPenaltyNode, SlidingOneKeepsItsMotionLessTheElasticPart) {
  const double load = 1.2 * this->limit(0);
  double dissipated = 0;
  for (int i = 0; i < 6000; ++i) {
    const double before = this->moved_ + this->friction_ / stiffness, force = this->friction_;
    this->advance(load * std::min(1.0, i / 2000.0));
    const double slip = this->moved_ + this->friction_ / stiffness - before;
    dissipated += 0.5 * (std::abs(force) + std::abs(this->friction_)) * std::abs(slip);
  }
  const double slip = this->moved_ + this->friction_ / stiffness;
  EXPECT_GT(slip, 1000 * this->limit(0) / stiffness) << "it did not slide";
  // The limit falls as the node gains speed: what that releases is not counted.
  const double share = TestFixture::single ? 1e-4 : 1e-5;
  EXPECT_NEAR(this->kept_slip(), slip, share * slip);
  EXPECT_NEAR(this->kept_work(), dissipated, share * dissipated);
}

} // namespace

} // namespace frictab::stuck_node_test
