// Errors, comparisons, noise floors and conditional use as parts of JSON files (io/json_fields.h).
#pragma once

#include "calibrate/judgement.h"

namespace frictab::io {
class Fields;
}

namespace frictab::calibrate {

void describe(io::Fields& f, Interval& interval); // [low, high]
void describe(io::Fields& f, Metrics& metrics);
void describe(io::Fields& f, Determination& determination);
void describe(io::Fields& f, Influence& influence);
void describe(io::Fields& f, Choice& choice);           // null where nothing was drawn
void describe(io::Fields& f, Recommended& recommended); // null where nothing judges the laws
void describe(io::Fields& f, Comparisons& comparisons);
void describe(io::Fields& f, Conditional& conditional); // null where it was not asked for

void describe_judged_by(io::Fields& f, const char* key, JudgedBy& judged_by);

// The first one, with the others as its `also`; null where there is none.
void describe_noise_floors(io::Fields& f, std::vector<NoiseFloor>& floors);

// Arrays over the experiments; null where none was left out. The names stand elsewhere.
void describe_unseen(io::Fields& f, std::vector<ExperimentError>& errors,
                     const std::vector<std::string>& experiments);

} // namespace frictab::calibrate
