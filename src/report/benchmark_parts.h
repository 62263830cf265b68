// Sections of benchmark.md beside the ranking.
#pragma once

#include <string>

#include "calibrate/calibration.h"

namespace frictab::report {

// A cell must not end its column or its row, nor be read as markup.
std::string markdown_cell(const std::string& text);

// The noise floor as a row of the ranking table (9 columns).
std::string floor_row(const calibrate::Calibration& calibration, int decimals);

// What the best law's error owes to its having been chosen by it.
// The law's name, and whether it is no candidate.
std::string markdown_law(const calibrate::ModelFit& fit);
// Which law to take, with an empty line before it; empty where none is recommended.
std::string recommended_paragraph(const calibrate::Calibration& calibration);
void add_choice(std::string& out, const calibrate::Choice& choice, int decimals);

void add_all_errors(std::string& out, const calibrate::Calibration& calibration, int decimals);
void add_band(std::string& out, const calibrate::Calibration& calibration);
void add_comparison(std::string& out, const calibrate::Calibration& calibration, int decimals);
void add_conditional_use(std::string& out, const calibrate::Calibration& calibration, int decimals);

} // namespace frictab::report
