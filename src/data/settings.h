// Settings of tests as they are searched: one value in each test, known before it.
#pragma once

#include <span>
#include <string>

#include "data/dataset.h"

namespace frictab::data {

// Replaces the readings of each test by their mean: their scatter is noise, which would hide what
// differs between tests.
void take_mean_of_tests(std::span<Dataset* const> parts, const std::string& name);

// Gives tests without a value the middle of the others, if at most a third of the tests lack it, so
// that the column can be searched. A caution names them.
void fill_missing_setting(std::span<Dataset* const> parts, const std::string& name);

// Asks, in a caution, about a setting of single-row tests that hardly any of them share, if
// friction follows it too closely for a condition: a shape from which friction was read off.
void ask_if_reading(std::span<Dataset* const> parts, const std::string& name);

} // namespace frictab::data
