// Figures of the paper, and the counterparts of a calibration.
#include "words/published.h"

#include <array>

#include "words/numbers.h"

namespace frictab::words {

// The paper's abstract; it does not name the constant to which 51.38 belongs.
std::span<const PublishedFigure> published_figures() {
  static const std::array<PublishedFigure, 4> figures = {
      {{"standard constants", "24 to 95"},
       {"of these, the Coulomb constant of the abstract", "51.38"},
       {"calibrated constants", "12 to 15"},
       {"neural network", "9.35"}}};
  return figures;
}

bool is_cold_forging(const calibrate::Calibration& calibration) {
  constexpr double least_MPa = 200;
  bool pressed = false, formed = false;
  for (const calibrate::ModelFit& fit : calibration.fits)
    for (const auto& [input, range] : fit.data_range) {
      pressed = pressed || (input == "sigma_n_MPa" && range.second >= least_MPa);
      formed = formed || input == "psi" || input == "sigma_f_MPa";
    }
  return pressed && formed;
}

LawKind kind_of(const models::Law& law) {
  if (law.calibrated == models::Calibrated::fixed) return LawKind::literature;
  if (law.calibrated == models::Calibrated::mean) return LawKind::constants;
  return law.name == "neural_network" ? LawKind::network : LawKind::calibrated;
}

std::optional<calibrate::Interval> mae_span(const calibrate::Calibration& calibration,
                                            LawKind kind) {
  std::optional<calibrate::Interval> span;
  for (const calibrate::ModelFit& fit : calibration.fits) {
    if (kind_of(*fit.model.law) != kind) continue;
    const double mae = fit.validation.mae_MPa;
    if (!span) span = calibrate::Interval{mae, mae};
    span->low = std::min(span->low, mae);
    span->high = std::max(span->high, mae);
  }
  return span;
}

std::string counterpart(const calibrate::Calibration& calibration, std::size_t index) {
  if (index == 1) {
    std::string text;
    for (const calibrate::ModelFit& fit : calibration.fits)
      if (kind_of(*fit.model.law) == LawKind::literature &&
          fit.model.law->quantity == models::PieceQuantity::mu)
        text += (text.empty() ? "" : ", ") + figures(fit.validation.mae_MPa) + " (" +
                fit.model.law->name + ")";
    return text;
  }
  const std::array<LawKind, 4> kinds = {LawKind::literature, LawKind::literature,
                                        LawKind::constants, LawKind::network};
  const auto span = mae_span(calibration, kinds.at(index));
  if (!span) return "";
  const std::string low = figures(span->low), high = figures(span->high);
  return low == high ? low : low + " to " + high;
}

} // namespace frictab::words
