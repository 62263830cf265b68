// Findings of a calibration in words and tables: the ranking of the laws, their comparison, all
// errors. Stresses in MPa.
#pragma once

#include <vector>

#include "calibrate/calibration.h"
#include "words/document.h"

namespace frictab::words {

// The laws by error with the noise floor, what is known of their order, which law is recommended,
// remarks, and the laws left out. brief: counts the laws that may be the best, full: names them.
Section ranking(const calibrate::Calibration& calibration, Detail detail = Detail::full);
// Laws fitted again to all tests, with errors and parameters of their own; without blocks where
// there are none.
Section delivered_laws(const calibrate::Calibration& calibration);
// All pairs of laws.
Section comparison(const calibrate::Calibration& calibration);
// All errors with intervals, and the noise floors.
Section all_errors(const calibrate::Calibration& calibration);
// The factors between which new tests lie.
Section experiment_band(const calibrate::Calibration& calibration);
// The largest terms of a polynomial; without blocks where no law is one.
Section polynomial_terms(const calibrate::Calibration& calibration);
// The paper's figures and those of this calibration.
Section published_comparison(const calibrate::Calibration& calibration);
// Laws with a gain from the beginning of each test; without blocks where it was not asked for.
Section conditional_use(const calibrate::Calibration& calibration);

} // namespace frictab::words
