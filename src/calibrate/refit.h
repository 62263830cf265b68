// Laws that are delivered from all experiments, after those of the training experiments were judged
// on the others.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibrate/calibration.h"

namespace frictab::calibrate {

// Fits every law of calibration.fits again to training and validation experiments together
// (ModelFit::on_all). As none is left that they have not seen, their errors are cross-validated
// over all experiments: below 30 each is left out in turn, else in ten folds. Nothing that was
// judged changes.
void refit_on_all(Calibration& calibration, const models::Conventions& conventions,
                  const CalibrationInput& input);

// The fold of each experiment in which errors of delivered laws are cross-validated.
std::vector<std::size_t> delivery_folds(const data::Dataset& all, std::uint64_t seed);

// What is delivered, and what to expect of it on new experiments; without a full stop at the end.
// Empty where there is nothing to tell: deliver = training, and all experiments are in it anyway.
std::string delivery_sentence(const Calibration& calibration, int decimals);

} // namespace frictab::calibrate
