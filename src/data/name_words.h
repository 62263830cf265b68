// Words in the names of columns.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace frictab::data {

// The words of a name in lower case, with single blanks between: "NormalForce_[N]" is "normal force
// n".
std::string words_of_name(const std::string& name);
// Expects the words of a name.
bool has_word(const std::string& name, std::initializer_list<std::string_view> words);
// True for a name that contains one of these, also within a word.
bool has_part(const std::string& name, std::initializer_list<std::string_view> parts);

// The words of a name with _ between them: "Mass loss [mg]" is mass_loss_mg.
std::string plain_name(const std::string& name);
// True if a regular expression is found in a text.
bool has_match(const char* pattern, const std::string& text);

// True for a quantity of the surroundings, which does not depend on the contact: the air's
// humidity, the temperature of the room. Expects the words of a name.
bool names_surroundings(const std::string& name);

// True for the name of a line that sums up others: "Mean", "Mittelwert".
bool names_sums(const std::string& name);

} // namespace frictab::data
