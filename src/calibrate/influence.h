// Which test, left out, moves a law, or the ranking.
//
// A test is named where a parameter moves by more than its standard error, both without that test
// (Belsley, Kuh and Welsch 1980, DFBETAS): with it an outlier widens the error by about as much as
// it moves the mean, and hides itself. Where tests were left out in turn the laws without them are
// there. Else they are found by one step from the normal equations, and the few that come out are
// fitted; laws that were trained are not asked.
//
// The first place is asked by leaving a test out of those that judge; laws are not fitted again
// for that.
#pragma once

#include "calibrate/calibration.h"

namespace frictab::calibrate {

// Fills calibration.influence for the laws as they are ranked.
void add_influence(Calibration& calibration, const models::Conventions& conventions,
                   const CalibrationInput& input);

// "test 't05' moves wzl by up to 2.1 standard errors: without it b = -0.081, not -0.12; without it
// log_coulomb would be first, not wzl", of what matters most; empty where no test does. Without a
// full stop.
std::string influence_sentence(const Calibration& calibration);

} // namespace frictab::calibrate
