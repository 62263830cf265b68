// Follows the sources of scales back to the raw value.
#include "io/tdms_scales.h"

#include <fmt/format.h>

#include "core/text.h"

namespace frictab::io::tdms {

namespace {

constexpr double most_scales = 64, most_coefficients = 64;

} // namespace

Scales::Scales(const Properties& properties) {
  if (lower_case(text_of(properties, "NI_Scaling_Status").value_or("")) == "scaled") return;
  const double count = number_of(properties, "NI_Number_Of_Scales").value_or(0);
  if (!(count >= 1)) return;
  if (count > most_scales) {
    unreadable_ = fmt::format("raw values with {} NI scales", count);
    return;
  }
  // a source that is not an earlier scale is the raw value
  for (double number = count - 1; number >= 0;) {
    const std::string scale = fmt::format("NI_Scale[{}]_", static_cast<int>(number));
    const auto type = text_of(properties, scale + "Scale_Type");
    if (!type) return;
    add(properties, scale, *type);
    if (!unreadable_.empty()) return;
    const double source =
        number_of(properties, scale + *type + "_Input_Source").value_or(number - 1);
    number = source < number ? source : -1;
  }
}

void Scales::add(const Properties& properties, const std::string& scale, const std::string& type) {
  if (type == "Polynomial") return add_polynomial(properties, scale);
  const auto slope = number_of(properties, scale + "Linear_Slope"),
             intercept = number_of(properties, scale + "Linear_Y_Intercept");
  if (type != "Linear")
    unreadable_ =
        fmt::format("raw values with an NI scale of type {}; log or export it scaled", type);
  else if (!slope || !intercept)
    unreadable_ = "raw values with an NI scale without slope or intercept";
  else
    steps_.push_back({*intercept, *slope});
}

void Scales::add_polynomial(const Properties& properties, const std::string& scale) {
  const std::string name = scale + "Polynomial_Coefficients";
  constexpr double usual = 4; // where the size is not given
  const double count = number_of(properties, name + "_Size").value_or(usual);
  Step step;
  for (int i = 0; i < count && count <= most_coefficients; ++i)
    if (const auto one = number_of(properties, fmt::format("{}[{}]", name, i)))
      step.push_back(*one);
  if (step.empty() || static_cast<double>(step.size()) != count)
    unreadable_ = "raw values with an NI scale without all its coefficients";
  else
    steps_.push_back(std::move(step));
}

void Scales::apply(std::vector<double>& values) const {
  for (auto step = steps_.rbegin(); step != steps_.rend(); ++step)
    for (double& value : values) {
      double result = 0;
      for (auto coefficient = step->rbegin(); coefficient != step->rend(); ++coefficient)
        result = result * value + *coefficient;
      value = result;
    }
}

} // namespace frictab::io::tdms
