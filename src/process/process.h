// Judgement of laws in a process: its states compared with the tests, differences of the laws
// there, changes of the force, and tests that would decide.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "process/coverage.h"
#include "process/design.h"
#include "process/resampled.h"
#include "process/stress.h"

namespace frictab::process {

struct LawThere {
  std::string law;
  bool candidate = true;    // false: a constant of the literature that the job does not name
  bool may_be_best = false; // not ruled out by the tests
  double best_in = 0;       // share of resampled tests in which it is best
  double near_error = 0; // mean relative error on the tests' rows, by their nearness to the process
  bool leads = false;    // may be best, is best in resamples, and errs little near the process
  double tau_MPa = 0;    // mean, by friction work of the used law
  double differs_MPa = 0;                   // mean distance from the used law's stress, likewise
  double late_percent = 0, end_percent = 0; // change of force, or of friction work
  std::vector<double> force_kN;             // per increment; empty without a tool
};

// Change of the result by one standard error of a parameter.
struct ParameterThere {
  std::string law, parameter;
  double percent = 0;
};

// Judgement by one set of tests.
struct Assessment {
  std::vector<LawThere> laws; // in the order of the ranking
  std::string take;           // recommended law, or the best that leads where it does not
  double low_percent = 0, high_percent = 0;         // of the laws that lead
  double all_low_percent = 0, all_high_percent = 0; // of all that are not ruled out
  double differ_MPa = 0; // standard deviation of tau_R between the laws that lead, by friction work
  Resampled resampled;
  std::optional<ParameterThere> parameter; // the one that matters most, of the law to take
  double open = 0; // standard deviation of ln tau over the process, whichever law is right
  std::size_t tests = 0;
  double thin = 0; // share of the friction work that is thinly tested

  const LawThere& law_to_take() const;
};

// Force-driven: no change of force can be predicted.
enum class Prediction { force, no_tool, force_driven, energy_driven, contact_changes };

struct Process {
  ContactHistory history;
  UsedLaw used;
  Coverage coverage;
  Assessment assessment;
  std::optional<Assessment> with_added; // with the tests of process.add
  ProposedTests proposed;
  std::vector<double> work_J; // friction work of each row, as it was
  Prediction prediction = Prediction::force;
  bool driven_was_found = false; // by the course of force and speed
  // Friction work here over that of the solver, minus 1, %; empty: the solver's is not known.
  std::optional<double> work_check_percent;
  double work_share_percent = 0; // of the tool's work; 0: not known
  bool synthetic = false;
  std::vector<std::string> cautions;

  const Assessment& latest() const { return with_added ? *with_added : assessment; }
};

// Judges the laws of a calibration in a process. `added`: tests with those of process.add. Throws
// InputError for files that cannot be used, and where the friction work is not the solver's.
Process judge_process(const Tests& tests, const Tests* added, const ProcessOptions& options,
                      const models::Conventions& conventions);

} // namespace frictab::process
