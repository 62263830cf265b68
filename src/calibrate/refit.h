// Refit of laws to all experiments for delivery, after those fitted to the training experiments
// were judged on the others.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibrate/calibration.h"

namespace frictab::calibrate {

// Refits every law of calibration.fits to training and validation experiments together
// (ModelFit::on_all). No unseen experiments remain, so their errors are cross-validated over all
// experiments: leave-one-out below 30, else ten folds. Earlier judgements stay unchanged.
void refit_on_all(Calibration& calibration, const models::Conventions& conventions,
                  const CalibrationInput& input);

// Returns the fold of each experiment in which errors of delivered laws are cross-validated.
std::vector<std::size_t> delivery_folds(const data::Dataset& all, std::uint64_t seed);

// Sentence, without a full stop at the end, about the data that the delivered laws are fitted to
// and their expected error on new experiments. Empty with deliver = training if all experiments are
// in it anyway.
std::string delivery_sentence(const Calibration& calibration, int decimals);

} // namespace frictab::calibrate
