// Checks what was asked of the synthetic tribometer.
#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "twin/twin.h"

namespace frictab {

namespace {

void check_choice(const std::string& option, const std::string& value,
                  const std::vector<std::string>& known, FaultList& faults) {
  if (std::find(known.begin(), known.end(), value) == known.end())
    faults.add({option}, "unknown " + option.substr(2) + " '" + value + "'", suggest(value, known));
}

} // namespace

void check_options(const TwinOptions& options) {
  FaultList faults;
  if (!(options.noise_scale >= 0 && options.noise_scale <= 5))
    faults.add({"--noise-scale"}, shortest(options.noise_scale) + " is outside 0 to 5",
               "1 is the noise of the parameter set, 0 is none");
  check_choice("--noise", options.noise, {"normal", "t4", "heteroscedastic"}, faults);
  check_choice("--profile", options.profile, {"constant", "varied"}, faults);
  faults.throw_if_any();
}

} // namespace frictab
