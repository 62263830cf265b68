// Tests that, left out, move a law's parameters or change the ranking.
//
// A test is listed if a parameter moves by more than its standard error, both computed without that
// test (Belsley, Kuh and Welsch 1980, DFBETAS): with the test, an outlier widens the error by about
// as much as it moves the mean, and masks itself. In leave-one-out the laws without each test exist
// already. Otherwise one step from the normal equations selects a few tests, and the law is
// refitted without these; trained laws are skipped.
//
// The influence on the first place is found by leaving a test out of those that judge, without
// refitting laws.
#pragma once

#include "calibrate/calibration.h"

namespace frictab::calibrate {

// Fills calibration.influence for the laws in ranking order.
void add_influence(Calibration& calibration, const models::Conventions& conventions,
                   const CalibrationInput& input);

// Sentence about the most important test, without a full stop: "test 't05' moves wzl by up to 2.1
// standard errors: without it b = -0.081, not -0.12; without it log_coulomb would be first, not
// wzl". Empty if no test matters.
std::string influence_sentence(const Calibration& calibration);

} // namespace frictab::calibrate
