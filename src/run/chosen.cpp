// Resolves the names in trace.models and table.model.
#include "run/chosen.h"

#include <algorithm>

#include "calibrate/band.h"
#include "calibrate/recommended.h"
#include "core/error.h"
#include "core/names.h"
#include "core/text.h"

namespace frictab::run {

using calibrate::ModelFit;

namespace {

using Fits = std::vector<const ModelFit*>;

void add_once(Fits& fits, const ModelFit& fit) {
  if (std::ranges::find(fits, &fit) == fits.end()) fits.push_back(&fit);
}

// True for constants of the literature and means: references to compare with, which tracing does
// not extend.
bool is_constant(const models::Law& law) {
  return law.calibrated == models::Calibrated::fixed || law.calibrated == models::Calibrated::mean;
}

Fits fits_named(const calibrate::Calibration& calibration, const std::string& law) {
  const ModelFit* const fit = calibrate::find_fit(calibration, law);
  return fit ? Fits{fit} : Fits();
}

// The fits of one entry of table.model.
Fits fits_of_entry(const calibrate::Calibration& calibration, const std::string& name,
                   const Place& place) {
  if (name == "best") return {&calibrate::best_fit(calibration)};
  if (name == "recommended") return {&calibrate::recommended_fit(calibration)};
  if (name == "all") {
    Fits fits;
    for (const ModelFit& fit : calibration.fits)
      fits.push_back(&fit);
    return fits;
  }
  Fits fits = fits_named(calibration, name);
  if (fits.empty())
    throw InputError(place, "table.model: law '" + name + "' was not calibrated",
                     models::read_model_name(name, {}).traced
                         ? "it is there where trace finds an effect that its law lacks"
                         : "add it to models.use, or map the columns it needs");
  return fits;
}

} // namespace

std::vector<const ModelFit*> fits_to_trace(const calibrate::Calibration& calibration,
                                           const trace::TraceOptions& options) {
  Fits chosen;
  for (const std::string& name : options.models) {
    if (name == "best") {
      add_once(chosen, calibrate::best_fit(calibration));
    } else if (name == "all") {
      for (const ModelFit& fit : calibration.fits)
        if (!is_constant(*fit.model.law)) add_once(chosen, fit);
    } else {
      for (const ModelFit* fit : fits_named(calibration, name))
        add_once(chosen, *fit);
    }
  }
  return chosen;
}

std::vector<const ModelFit*> simpler_laws(const calibrate::Calibration& calibration) {
  const ModelFit& best = calibrate::best_fit(calibration);
  const auto is_simpler = [&](const ModelFit& fit) {
    return !fit.reference && &fit != &best && !is_constant(*fit.model.law) && !fit.network &&
           !fit.polynomial;
  };
  Fits simpler;
  for (const ModelFit& fit : calibration.fits)
    if (is_simpler(fit)) simpler.push_back(&fit);
  if (simpler.empty()) return simpler;
  Fits laws;
  const auto is_as_good = [&](const ModelFit* fit) {
    const calibrate::Recommended& r = calibration.recommended;
    const std::string& name = fit->model.law->name;
    return name == r.law || std::ranges::find(r.as_good, name) != r.as_good.end();
  };
  const auto numbers = [&](const ModelFit* fit) {
    return calibrate::numbers_of(*fit, calibration.fits);
  };
  Fits as_good;
  std::ranges::copy_if(simpler, std::back_inserter(as_good), is_as_good);
  if (!as_good.empty()) add_once(laws, **std::ranges::min_element(as_good, {}, numbers));
  add_once(laws, *simpler.front());
  return laws;
}

const ModelFit& fit_named(const calibrate::Calibration& calibration, const std::string& name,
                          const table::TableOptions& options) {
  if (name.empty())
    return *fits_of_entry(calibration, options.model.front(), options.place).front();
  if (name == "best") return calibrate::best_fit(calibration);
  if (name == "recommended") return calibrate::recommended_fit(calibration);
  const Fits fits = fits_named(calibration, name);
  if (!fits.empty()) return *fits.front();
  const auto known =
      all_names(calibration.fits, [](const ModelFit& fit) { return fit.model.law->name; });
  throw InputError({}, "law '" + name + "' was not calibrated", suggest(name, known));
}

std::vector<models::Model> models_to_tabulate(const calibrate::Calibration& calibration,
                                              const table::TableOptions& options) {
  Fits chosen;
  for (const std::string& name : options.model)
    for (const ModelFit* fit : fits_of_entry(calibration, name, options.place))
      add_once(chosen, *fit);
  std::vector<models::Model> models;
  for (const ModelFit* fit : chosen)
    for (const double quantile : options.quantile)
      models.push_back(calibrate::at_quantile(fit->delivered().model, quantile, options.place));
  return models;
}

} // namespace frictab::run
