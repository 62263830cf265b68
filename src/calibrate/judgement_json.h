// Errors, comparisons, noise floors and conditional use as parts of JSON files (io/json_fields.h).
#pragma once

#include "calibrate/judgement.h"
#include "io/json_fields.h"

namespace frictab::calibrate {

void describe(io::Fields& f, Metrics& metrics);
void describe(io::Fields& f, Determination& determination);
void describe(io::Fields& f, Influence& influence);
void describe(io::Fields& f, Choice& choice);           // null if nothing was drawn
void describe(io::Fields& f, Recommended& recommended); // null if no errors rank the laws
void describe(io::Fields& f, Comparisons& comparisons);
void describe(io::Fields& f, Conditional& conditional); // null if not requested

void describe_judged_by(io::Fields& f, const char* key, JudgedBy& judged_by);

// Describes the first noise floor, with the others as its `also`; null if there are none.
void describe_noise_floors(io::Fields& f, std::vector<NoiseFloor>& floors);

// Describes arrays over the experiments, whose names are stored elsewhere; null if no experiment
// was left out.
void describe_unseen(io::Fields& f, std::vector<ExperimentError>& errors,
                     const std::vector<std::string>& experiments);

} // namespace frictab::calibrate
