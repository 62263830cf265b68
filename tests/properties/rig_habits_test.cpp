// Habits of rigs, each on and off over 50 campaigns: the law that comes out is that of the clean
// campaign within its standard errors, and what was done about the habit is said. Synthetic.
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibration.h"
#include "core/error.h"
#include "job/job.h"
#include "run/data_summary.h"
#include "run/job_data.h"
#include "support/rig.h"

namespace frictab::rig_habits_test {
namespace {

using test::Habit;
using testing::HasSubstr;

constexpr std::uint64_t campaigns = 50;

struct Outcome {
  std::vector<double> parameters, std_error;
  std::string said; // as `frictab data` says it, or the error
  bool fitted = false;
};

Outcome outcome_of(std::uint64_t seed, Habit habit) {
  const test::TemporaryDirectory directory;
  test::write_rig(directory, seed, habit);
  Outcome outcome;
  try {
    const job::Job job = job::read_job(directory.path("job.toml"));
    const run::JobData data = run::load_job_data(job);
    outcome.said = run::data_text(data);
    const calibrate::Calibration calibration = calibrate::calibrate(data.calibration_input(job));
    outcome.parameters = calibration.fits.front().model.parameters;
    outcome.std_error = calibration.fits.front().std_error;
    outcome.fitted = true;
  } catch (const InputError& error) {
    outcome.said = error.what();
  }
  return outcome;
}

const Outcome& clean(std::uint64_t seed) {
  static std::map<std::uint64_t, Outcome> known;
  const auto found = known.find(seed);
  return found != known.end() ? found->second
                              : known.emplace(seed, outcome_of(seed, Habit::none)).first->second;
}

// The largest difference of a parameter, in standard errors of the clean campaign's.
double moved(const Outcome& habit, const Outcome& clean) {
  double most = 0;
  for (std::size_t p = 0; p < clean.parameters.size(); ++p)
    most = std::max(most, std::abs(habit.parameters[p] - clean.parameters[p]) / clean.std_error[p]);
  return most;
}

struct Expected {
  const char* said;    // a part of it
  double furthest = 1; // standard errors
};

// What is said of each habit; where no law may come out, `furthest` is 0.
Expected expected(Habit habit) {
  switch (habit) {
  case Habit::raw_channels:
    return {"belongs to the measured friction"};
  case Habit::coefficient_beside:
    return {"COF belongs to the measured friction"};
  case Habit::torque:
    return {"Torque [Nmm] belongs to the measured friction"};
  case Habit::rest:
    return {"rest"};
  case Habit::reversals:
    return {"direction"};
  case Habit::offset:
    return {"as the zero of the force cell"};
  case Habit::intervals:
    return {"interval"};
  case Habit::kilonewtons:
    return {"kN"};
  case Habit::kelvin:
    return {"S10", 0};
  case Habit::spikes:
    return {"S07.csv:39"};
  case Habit::copied_test:
    return {"test 'S17' has the rows of test 'S05'"};
  default:
    return {""};
  }
}

class LongRigHabits : public testing::TestWithParam<Habit> {};

TEST_P(LongRigHabits, LeaveTheLawOfTheCleanCampaignAndAreSaid) {
  const auto [said, furthest] = expected(GetParam());
  double most = 0;
  for (std::uint64_t seed = 1; seed <= campaigns; ++seed) {
    const Outcome outcome = outcome_of(seed, GetParam());
    ASSERT_THAT(outcome.said, HasSubstr(said)) << "seed " << seed;
    if (furthest == 0) continue;
    ASSERT_TRUE(outcome.fitted) << outcome.said << "seed " << seed;
    most = std::max(most, moved(outcome, clean(seed)));
  }
  EXPECT_LE(most, furthest) << "standard errors";
  RecordProperty("largest_move_in_standard_errors", fmt::format("{:.3f}", most));
}

INSTANTIATE_TEST_SUITE_P(Each, LongRigHabits, testing::ValuesIn(test::habits()),
                         [](const auto& each) { return std::string(test::name_of(each.param)); });

} // namespace
} // namespace frictab::rig_habits_test
