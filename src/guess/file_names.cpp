// Finds conditions in the names of files and folders.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/text.h"
#include "data/test_table.h"
#include "guess/guess.h"
#include "guess/layout.h"
#include "io/number.h"

namespace frictab::guess {

namespace {

struct Token {
  std::string number, unit; // "20mm": 20, mm; both empty for a text
};

Token token_of(const std::string& text) {
  std::size_t end = 0;
  while (end < text.size() && (std::isdigit(static_cast<unsigned char>(text[end])) ||
                               text[end] == '.' || text[end] == ','))
    ++end;
  const bool trailing = end > 0 && !std::isdigit(static_cast<unsigned char>(text[end - 1]));
  if (end == 0 || trailing) return {};
  const std::string behind = text.substr(end);
  const bool letters = std::all_of(behind.begin(), behind.end(), [](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
  });
  return letters ? Token{text.substr(0, end), behind} : Token{};
}

struct CutName {
  std::vector<std::string> tokens;
  std::string signs;          // separators between them
  std::size_t date = no_date; // token that is a date, with the time of day after it

  static constexpr std::size_t no_date = static_cast<std::size_t>(-1);

  // Joins a token with the `more` ones after it.
  void join_tokens(std::size_t first, std::size_t more) {
    for (; more > 0; --more) {
      tokens[first] += signs[first] + tokens[first + 1];
      tokens.erase(tokens.begin() + static_cast<long>(first) + 1);
      signs.erase(first, 1);
    }
  }
};

bool are_digits(const std::string& text, std::size_t least, std::size_t most) {
  return text.size() >= least && text.size() <= most &&
         text.find_first_not_of("0123456789") == text.npos;
}

bool is_day(const std::string& year, const std::string& month, const std::string& day) {
  return are_digits(year, 4, 4) && (year.starts_with("19") || year.starts_with("20")) &&
         are_digits(month, 1, 2) && are_digits(day, 1, 2) && std::stoi(month) >= 1 &&
         std::stoi(month) <= 12 && std::stoi(day) >= 1 && std::stoi(day) <= 31;
}

// A date in one token: 20260302, 10.03.2026, 2026.03.10.
bool is_date(const std::string& text) {
  if (are_digits(text, 8, 8)) return is_day(text.substr(0, 4), text.substr(4, 2), text.substr(6));
  const std::size_t first = text.find('.'), second = text.find('.', first + 1);
  if (first == text.npos || second == text.npos) return false;
  const std::string a = text.substr(0, first), b = text.substr(first + 1, second - first - 1),
                    c = text.substr(second + 1);
  return is_day(a, b, c) || is_day(c, b, a);
}

// A time of day: 0900, 090015.
bool is_time(const std::string& text) {
  return (are_digits(text, 4, 4) || are_digits(text, 6, 6)) && text.substr(0, 2) < "24" &&
         text[2] < '6' && (text.size() == 4 || text[4] < '6');
}

// Joins the parts of a date, and those of a time of day that follows it.
void join_date(CutName& name) {
  const auto& tokens = name.tokens;
  for (std::size_t i = 0; i < tokens.size() && name.date == CutName::no_date; ++i) {
    const bool three = i + 2 < tokens.size() && name.signs[i] == name.signs[i + 1];
    if (is_date(tokens[i]))
      name.date = i;
    else if (three && (is_day(tokens[i], tokens[i + 1], tokens[i + 2]) ||
                       is_day(tokens[i + 2], tokens[i + 1], tokens[i]))) {
      name.join_tokens(i, 2);
      name.date = i;
    }
  }
  const std::size_t after = name.date == CutName::no_date ? name.no_date : name.date + 1;
  if (after >= tokens.size()) return;
  const bool in_parts = after + 2 < tokens.size() && name.signs[after] == '-' &&
                        name.signs[after + 1] == '-' && name.signs[after - 1] != '-' &&
                        is_time(tokens[after] + tokens[after + 1] + tokens[after + 2]);
  if (in_parts || is_time(tokens[after])) name.join_tokens(name.date, in_parts ? 3 : 1);
}

CutName cut(const std::string& file) {
  CutName name;
  std::string token;
  for (const char c : std::filesystem::path(file).stem().string()) {
    if (c != '_' && c != '-' && c != ' ') {
      token += c;
      continue;
    }
    name.tokens.push_back(token);
    name.signs += c;
    token.clear();
  }
  name.tokens.push_back(token);
  return name;
}

// The names with their dates joined, if all have one at the same place.
std::vector<CutName> with_dates(std::vector<CutName> names) {
  std::vector<CutName> joined = names;
  for (CutName& name : joined)
    join_date(name);
  const CutName& first = joined.front();
  const bool alike = first.date != CutName::no_date &&
                     std::all_of(joined.begin(), joined.end(), [&](const CutName& name) {
                       return name.date == first.date && name.signs == first.signs;
                     });
  return alike ? joined : names;
}

bool is_alone_a_date(const std::string& text) {
  CutName name = cut(text + ".x"); // a point in it begins no extension
  join_date(name);
  return name.date == 0 && name.tokens.size() == 1;
}

// The form of a date: its runs of digits, and the signs between them.
std::string pattern_of_date(const std::string& date) {
  std::string out;
  for (const char c : date)
    if (std::isdigit(static_cast<unsigned char>(c)) == 0)
      out += as_pattern(std::string(1, c));
    else if (!out.ends_with("\\d+"))
      out += "\\d+";
  return out;
}

// Sorts numbers by size, texts alphabetically; limited to one line.
std::string list_of(const std::set<std::string>& values) {
  std::vector<std::string> list(values.begin(), values.end());
  const auto number = [](const std::string& text) {
    double value = 0;
    return io::read_number(text, '.', value) || io::read_number(text, ',', value) ? value : 0;
  };
  std::stable_sort(list.begin(), list.end(), [&](const std::string& a, const std::string& b) {
    return number(a) < number(b);
  });
  constexpr std::size_t shown = 8;
  if (list.size() > shown) {
    list.resize(shown);
    list.emplace_back("...");
  }
  return join(list, ", ");
}

// The texts at one position of all names.
class NamePlace {
public:
  explicit NamePlace(const std::vector<std::string>& texts) : first_(texts.front()) {
    for (const std::string& text : texts) {
      const Token token = token_of(text);
      values_.insert(text);
      numbers_.insert(token.number);
      units_.insert(token.unit);
    }
  }

  bool differs() const { return values_.size() > 1; }
  bool has_empty() const { return values_.count("") > 0; }
  // True for the number of a condition with its unit, as 20mm.
  bool is_measured() const {
    return numbers_.count("") == 0 && units_.size() == 1 && !units_.begin()->empty();
  }
  bool names_test(std::size_t tests) const {
    return values_.size() == tests && tests > 2 && !is_measured();
  }
  // True for the numbers of repeated tests: 1, 2, 3 or rep1, rep2.
  bool counts_repeats(std::size_t tests) const {
    std::set<std::string> letters;
    std::set<long> numbers;
    for (const std::string& text : values_) {
      letters.insert(lower_case(text.substr(0, text.find_first_of("0123456789"))));
      numbers.insert(data::first_number(text));
    }
    const std::set<std::string> before = {"",      "r",      "rep",     "repeat", "replicate",
                                          "w",     "wdh",    "no",      "nr",     "run",
                                          "probe", "sample", "specimen"};
    return letters.size() == 1 && before.count(*letters.begin()) > 0 && numbers.size() > 1 &&
           2 * numbers.size() <= tests && *numbers.begin() == 1 &&
           *numbers.rbegin() == static_cast<long>(numbers.size());
  }
  std::string same() const { return as_pattern(first_); }

  // A named group of `letters`; for measured parts the unit is added to the name.
  std::string group(std::string name, const std::string& letters, NamePattern& guess) const {
    if (is_measured()) name += "_" + *units_.begin();
    guess.parts.push_back({name, list_of(is_measured() ? numbers_ : values_)});
    return is_measured() ? fmt::format("(?<{}>[\\d.,]+){}", name, *units_.begin())
                         : fmt::format("(?<{}>{})", name, letters);
  }

private:
  const std::string& first_;
  std::set<std::string> values_, numbers_, units_;
};

bool has_group(const NamePattern& guess, const char* group) {
  return std::any_of(guess.parts.begin(), guess.parts.end(),
                     [&](const NamePart& part) { return part.group == group; });
}

bool names_test(const NamePattern& guess) {
  return has_group(guess, "experiment");
}

// Pattern for one position of the files' own names, the `number`th from 1.
std::string part_of_name(const NamePlace& place, std::size_t number, bool is_last,
                         std::size_t tests, NamePattern& guess) {
  const char* const letters = "[^_ /-]+";
  if (!place.differs()) return place.same();
  if (place.names_test(tests))
    return names_test(guess) ? letters : place.group("experiment", letters, guess);
  if (is_last && number > 1 && place.counts_repeats(tests))
    return place.group("repeat", letters, guess);
  return place.group(fmt::format("{}{}", place.is_measured() ? "x" : "name", number), letters,
                     guess);
}

// Pattern of names with other numbers of parts, of which the last one counts repeats of each rest.
std::string guess_repeats(const std::vector<CutName>& names, NamePattern& guess) {
  std::vector<std::string> last, rest;
  std::map<std::string, std::set<std::string>> repeats;
  for (const CutName& name : names) {
    if (name.tokens.size() < 2 || name.signs.back() != names.front().signs.back()) return "";
    last.push_back(name.tokens.back());
    CutName other = name;
    other.tokens.pop_back();
    other.join_tokens(0, other.tokens.size() - 1);
    rest.push_back(other.tokens.front());
    repeats[rest.back()].insert(last.back());
  }
  const NamePlace place(last), groups(rest);
  const bool repeated = std::all_of(repeats.begin(), repeats.end(),
                                    [](const auto& one) { return one.second.size() > 1; });
  if (!groups.differs() || !repeated || !place.counts_repeats(names.size())) return "";
  const std::string pattern =
      groups.group("name1", "[^/]+", guess) +
      as_pattern(names.front().signs.substr(names.front().signs.size() - 1));
  return pattern + place.group("repeat", "[^_ /-]+", guess);
}

// Pattern of names with the same parts; empty for others.
std::string guess_parts(const std::vector<CutName>& names, NamePattern& guess) {
  const CutName& first = names.front();
  if (std::any_of(names.begin(), names.end(),
                  [&](const CutName& name) { return name.signs != first.signs; }))
    return "";
  NamePattern found;
  std::string pattern;
  for (std::size_t t = 0; t < first.tokens.size(); ++t) {
    std::vector<std::string> texts;
    for (const CutName& name : names)
      texts.push_back(name.tokens[t]);
    const NamePlace place(texts);
    if (place.has_empty() && place.differs()) return "";
    if (t > 0) pattern += as_pattern(first.signs.substr(t - 1, 1));
    if (t == first.date && place.differs()) {
      const std::string form = pattern_of_date(first.tokens[t]);
      pattern += has_group(guess, "date") ? form : place.group("date", form, found);
      continue;
    }
    pattern += part_of_name(place, t + 1, t + 1 == first.tokens.size(), names.size(), found);
  }
  // A pattern that only distinguishes the tests is not needed: the file's own name does the same.
  if (found.parts.empty() || (found.parts.size() == 1 && names_test(found))) return "";
  guess.parts.insert(guess.parts.end(), found.parts.begin(), found.parts.end());
  return pattern;
}

// Pattern of the folders from the first one that differs, each followed by a /; empty if they give
// no information: all equal, at different depths, or one per file.
std::string guess_folders(const std::vector<std::string>& files, NamePattern& guess) {
  std::vector<std::vector<std::string>> folders;
  std::set<std::string> all;
  for (const std::string& file : files) {
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    all.insert(folder.string());
    folders.emplace_back();
    for (const auto& part : folder)
      folders.back().push_back(part.string());
    if (folders.back().size() != folders.front().size()) return "";
  }
  if (all.size() == files.size()) return "";
  std::string pattern;
  for (std::size_t level = 0; level < folders.front().size(); ++level) {
    std::vector<std::string> texts;
    for (const auto& folder : folders)
      texts.push_back(folder[level]);
    const NamePlace place(texts);
    const std::string number = guess.parts.empty() ? "" : std::to_string(guess.parts.size() + 1);
    const bool dates = std::all_of(texts.begin(), texts.end(), is_alone_a_date);
    if (place.differs() && dates && !has_group(guess, "date"))
      pattern += place.group("date", pattern_of_date(texts.front()), guess) + "/";
    else if (place.differs())
      pattern += place.group("folder" + number, "[^/]+", guess) + "/";
    else if (!pattern.empty())
      pattern += place.same() + "/";
  }
  return pattern;
}

// The files' common extension, or any.
std::string end_of_names(const std::vector<std::string>& files) {
  std::set<std::string> extensions;
  for (const std::string& file : files)
    extensions.insert(std::filesystem::path(file).extension().string());
  return (extensions.size() == 1 ? as_pattern(*extensions.begin()) : "(\\.[^./]*)?") + "$";
}

} // namespace

NamePattern guess_names(const std::vector<std::string>& files) {
  NamePattern guess;
  if (files.size() < 2) return guess;
  std::vector<CutName> names;
  for (const std::string& file : files)
    names.push_back(cut(file));
  names = with_dates(std::move(names));
  const std::string folders = guess_folders(files, guess);
  std::string parts = guess_parts(names, guess);
  if (parts.empty()) parts = guess_repeats(names, guess);
  if (!parts.empty())
    guess.pattern = folders + parts + end_of_names(files);
  else if (!folders.empty())
    guess.pattern = folders + "[^/]*$";
  return guess;
}

} // namespace frictab::guess
