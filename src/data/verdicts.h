// Verdicts on tests ("valid", "nok", a remark "do not use"), passed when the tests were over: no
// condition of a test.
#pragma once

#include <span>
#include <string>

#include "data/dataset.h"

namespace frictab::data {

// True for a verdict by name and texts. Yes and no need a name that says what they answer; "ok" and
// "nok" do not.
bool is_verdict(const Column& column);
bool is_verdict(std::span<Dataset* const> parts, const std::string& name);

// Notes the tests that a column of verdicts or remarks judges to be bad and that are used, and the
// way to leave them out.
void report_bad_tests(std::span<Dataset* const> parts, const std::string& name);

} // namespace frictab::data
