// Finds conditions in the names of files and folders.
#include <algorithm>
#include <cctype>
#include <filesystem>
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
  std::string signs; // separators between them
};

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
    const std::set<std::string> before = {"", "r", "rep", "repeat", "replicate", "w", "wdh"};
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

bool names_test(const NamePattern& guess) {
  return std::any_of(guess.parts.begin(), guess.parts.end(),
                     [](const NamePart& part) { return part.group == "experiment"; });
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
    if (place.differs())
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
  const std::string folders = guess_folders(files, guess);
  const std::string parts = guess_parts(names, guess);
  if (!parts.empty())
    guess.pattern = folders + parts + end_of_names(files);
  else if (!folders.empty())
    guess.pattern = folders + "[^/]*$";
  return guess;
}

} // namespace frictab::guess
