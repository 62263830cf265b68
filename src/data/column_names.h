// Quantities by the names that rigs and offices give their columns.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace frictab::data {

struct GuessedColumn; // sniff.h

// The words of a name in lower case, with single blanks between: "NormalForce_[N]" is "normal force
// n".
std::string words_of_name(const std::string& name);
// Expects the words of a name.
bool has_word(const std::string& name, std::initializer_list<std::string_view> words);

// True for the name of a line that sums up others: "Mean", "Mittelwert".
bool names_sums(const std::string& name);

// The factor of a recorded speed of rotation in a formula for mm/s at a radius in mm: "2*pi/60" for
// rpm; empty for other columns.
std::string turn_factor(const GuessedColumn& column);

// True for a wanted value, as opposed to a measured one: "Speed setpoint".
bool names_wanted(const GuessedColumn& column);

// Assigns each quantity to the column with the greatest likeness, the first one of equals.
void name_columns(std::vector<GuessedColumn>& columns);

} // namespace frictab::data
