// Numbers as people read them in tables.
#pragma once

#include <string>
#include <vector>

#include "calibrate/calibration.h"

namespace frictab::words {

// Writes `digits` significant digits: 12,345 or 0.00123 or 1.2e-15; a dash where not finite.
std::string figures(double value, int digits = 3);

// Writes the same without zeros at the end: 500, 0.5, 2,750.
std::string short_figures(double value, int digits = 4);

// Writes `decimals` digits after the point, with thousands separators and a minus sign; a dash
// where not finite.
std::string fixed(double value, int decimals);

// Writes "9.69 to 13.54"; a dash without an interval.
std::string interval_text(const calibrate::Interval& interval, int decimals);

// Explanation of a band's factors, and the texts of its two columns: "0.848" or a dash, "28 of 30
// (90 % expected)".
inline constexpr const char* band_sentence =
    "Tests differ from the law by a factor that no input explains. Of new experiments, 5 % are "
    "expected below the law times the first factor and 95 % below the law times the second (order "
    "statistics of the training experiments' factors, spread for the fitted parameters; the neural "
    "network's from nets that had not seen the experiment). table.quantile = [0.05, 0.5, 0.95] "
    "writes tables and sources of both ends.";
std::string factor_text(const std::optional<double>& factor);
std::string inside_text(const calibrate::BandCheck& band);

// Writes "0.023", or "< 0.001".
std::string p_text(double p_value);

// Counts the experiments that conditional use had to evaluate without their start, or could not
// evaluate.
std::string conditional_counts(const calibrate::Conditional& conditional);

// Decimals of the ranking's errors, by the best law's error and the largest.
int error_decimals(const calibrate::Calibration& calibration);

// Value and standard error with as many digits as the error justifies: "0.1276", "0.0005".
struct ValueText {
  std::string value;
  std::string std_error; // empty without an error
};
ValueText with_error(double value, double std_error);
// "mu = 0.0792 \u00B1 0.0020", with the unit unless it is 1.
std::string parameter_text(const std::string& name, const ValueText& value,
                           const std::string& unit);

// Writes "1 row", "16,500 rows".
std::string count_of(std::size_t count, const std::string& noun);
// Writes "a, b, c and 2 others"; needs at least one name.
std::string list_of(const std::vector<std::string>& names);

} // namespace frictab::words
