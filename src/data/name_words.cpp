// Words in the names of columns.
#include "data/name_words.h"

#include <algorithm>
#include <cctype>

#include "core/pattern.h"
#include "core/text.h"

namespace frictab::data {

namespace {

bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}
bool is_small(char c) {
  return c >= 'a' && c <= 'z';
}

// "NormalForce" in two words; "CoF" is one.
std::string with_blanks_between_words(const std::string& name) {
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (i > 0 && i + 1 < name.size() && is_small(name[i - 1]) && is_capital(name[i]) &&
        is_small(name[i + 1]))
      out += ' ';
    out += name[i];
  }
  return out;
}

} // namespace

std::string words_of_name(const std::string& name) {
  std::string out;
  for (const char c : lower_case(with_blanks_between_words(name)))
    out += std::isalnum(static_cast<unsigned char>(c)) || (c & 0x80) ? c : ' ';
  while (!out.empty() && out.back() == ' ')
    out.pop_back();
  while (out.find("  ") != out.npos)
    out = replace_all(out, "  ", " ");
  return out;
}

bool has_word(const std::string& name, std::initializer_list<std::string_view> words) {
  const std::string padded = " " + name + " ";
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
    return padded.find(" " + std::string(word) + " ") != padded.npos;
  });
}

bool has_part(const std::string& name, std::initializer_list<std::string_view> parts) {
  return std::ranges::any_of(parts,
                             [&](std::string_view part) { return name.find(part) != name.npos; });
}

std::string plain_name(const std::string& name) {
  return replace_all(words_of_name(name), " ", "_");
}

bool has_match(const char* pattern, const std::string& text) {
  return Pattern(pattern, {}).search(text).has_value();
}

bool names_surroundings(const std::string& name) {
  return has_word(name, {"room", "ambient", "air", "raum", "umgebung", "lab", "labor", "laboratory",
                         "hall", "halle", "climate", "klima", "environment", "rh", "dewpoint"}) ||
         has_match("humid|feucht|raumtemp|umgebungstemp|labortemp|hallentemp|lufttemp|dew point",
                   name);
}

bool names_sums(const std::string& name) {
  return has_word(words_of_name(name), {"mean", "average", "avg", "std", "stdev", "mittelwert",
                                        "mittel", "standardabweichung", "stabw", "moyenne"}) &&
         name.find_first_of("0123456789") == name.npos;
}

} // namespace frictab::data
