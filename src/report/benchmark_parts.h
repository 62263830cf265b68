// Sections of benchmark.md other than the ranking.
#pragma once

#include <string>

#include "calibrate/calibration.h"

namespace frictab::report {

// Escapes text for a table cell, so that it neither ends its column or row nor is read as markup.
std::string markdown_cell(const std::string& text);

// Returns the noise floor as a row of the ranking table (9 columns).
std::string floor_row(const calibrate::Calibration& calibration, int decimals);

// Returns the law's name, marked if the law is not a candidate.
std::string markdown_law(const calibrate::ModelFit& fit);
// Names the recommended law, with an empty line before it; empty without a recommendation.
std::string recommended_paragraph(const calibrate::Calibration& calibration);
// Adds the part of the best law's error that is due to choosing the law by that same error.
void add_choice(std::string& out, const calibrate::Choice& choice, int decimals);

void add_all_errors(std::string& out, const calibrate::Calibration& calibration, int decimals);
void add_band(std::string& out, const calibrate::Calibration& calibration);
void add_comparison(std::string& out, const calibrate::Calibration& calibration, int decimals);
void add_conditional_use(std::string& out, const calibrate::Calibration& calibration, int decimals);

} // namespace frictab::report
