// Figures of the paper that this program follows, for comparison with a user's own.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "calibrate/calibration.h"

namespace frictab::words {

// Mean absolute errors of tau_R, MPa, on the paper's own measured data.
struct PublishedFigure {
  std::string what;
  std::string mae_MPa;
};
std::span<const PublishedFigure> published_figures();

inline constexpr const char* published_source =
    "Comparison of Conventional and Data-Driven Friction Models for Cold Forging on a Shear Stress "
    "Level";
inline constexpr const char* published_warning =
    "The published figures refer to the paper's own measured data, not to yours; they show the "
    "order of magnitude.";

// Whether the campaign is of cold forging, as the paper's: contact normal stresses of hundreds of
// MPa, and the surface grows or a flow stress is known.
bool is_cold_forging(const calibrate::Calibration& calibration);

// Returns this calibration's figure for comparison with published_figures()[index]: "24.2 to 94.8",
// or empty if it has none of that kind.
std::string counterpart(const calibrate::Calibration& calibration, std::size_t index);

// Range of the validation MAE of the laws of one kind.
enum class LawKind { literature, constants, calibrated, network }; // constants: means of the data
LawKind kind_of(const models::Law& law);
std::optional<calibrate::Interval> mae_span(const calibrate::Calibration& calibration,
                                            LawKind kind);

} // namespace frictab::words
