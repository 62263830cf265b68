// Compares columns test by test.
#include "data/repeated_columns.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/text.h"
#include "data/clear_levels.h"
#include "data/name_words.h"
#include "data/quantity.h"
#include "data/roles.h"

namespace frictab::data {

namespace {

// Texts of the tests of all parts; empty for a column that changes within a test.
std::vector<std::string> texts_of_tests(std::span<Dataset* const> parts, const std::string& name) {
  std::vector<std::string> texts;
  for (const Dataset* part : parts) {
    const Column* column = part->find(name);
    if (!column) return {};
    for (std::size_t e = 0; e < part->experiments.size(); ++e) {
      const double first = column->values[part->first_row[e]];
      for (std::size_t i = part->first_row[e]; i < part->first_row[e + 1]; ++i)
        if (column->values[i] != first) return {};
      texts.push_back(column->levels.empty() ? fmt::format("{}", first)
                                             : column->levels[static_cast<std::size_t>(first)]);
    }
  }
  return texts;
}

void ignore(std::span<Dataset* const> parts, const std::string& name, const std::string& why) {
  for (Dataset* part : parts)
    for (Column& column : part->columns)
      if (column.name == name) {
        column.role = Role::ignore;
        column.why = why;
      }
}

// Parts of file names are called name1, x2_MPa, ...
bool is_part_of_name(const std::string& name) {
  return has_match("^(name|x)[0-9]+($|_)", name);
}

// Ignores columns that repeat another one in every test.
void ignore_copies(std::span<Dataset* const> parts) {
  std::map<std::vector<std::string>, std::vector<std::string>> alike; // texts -> columns
  for (const Column& column : parts.front()->columns)
    if ((column.role == Role::label || column.role == Role::setting ||
         (column.role == Role::test && !column.levels.empty())) &&
        column.why != set_by_job && !find_quantity(column.name))
      if (auto texts = texts_of_tests(parts, column.name); !texts.empty())
        alike[std::move(texts)].push_back(column.name);
  for (auto& [texts, names] : alike) {
    if (std::set<std::string>(texts.begin(), texts.end()).size() < 2) continue;
    std::stable_partition(names.begin(), names.end(),
                          [](const std::string& name) { return !is_part_of_name(name); });
    for (std::size_t i = 1; i < names.size(); ++i)
      ignore(parts, names[i], "the same as " + names.front() + " in every test");
  }
}

// Names that people give to combinations of settings.
constexpr const char* combination_names =
    "^((test|versuchs?|mess|exp|experiment|replicates?|repeat|wiederhol\\w*|parameter|process|run|"
    "sample|proben|load)_?)?(group|gruppe|series|serie|reihe|condition|bedingung|combination|combo|"
    "kombination|configuration|config|case|variante?|block|cell|zelle|design_?point)"
    "(en|s)?(_?(id|no|nr|number|nummer|name))?$";

// Setting of the tests: one value of each.
struct Factor {
  std::string name;
  std::vector<std::size_t> of; // level of each test
  std::size_t count = 0;
  std::vector<std::string> texts; // of each test
};

// Recorded columns with values that tests share.
std::optional<Factor> factor_of(std::span<Dataset* const> parts, const std::string& name) {
  Factor factor{name, {}, 0, texts_of_tests(parts, name)};
  const std::set<std::string> levels(factor.texts.begin(), factor.texts.end());
  if (levels.size() < 2 || 2 * levels.size() > factor.texts.size()) return {};
  for (const std::string& text : factor.texts)
    factor.of.push_back(static_cast<std::size_t>(std::distance(levels.begin(), levels.find(text))));
  factor.count = levels.size();
  return factor;
}

// States that were run at clear levels. Their texts are the tests' means.
std::optional<Factor> factor_of_state(std::span<Dataset* const> parts, const Quantity& state) {
  std::vector<double> means;
  for (const Dataset* part : parts) {
    if (!part->has(state.name)) return {};
    const auto values = part->values(state.name);
    for (std::size_t e = 0; e < part->experiments.size(); ++e)
      means.push_back(
          std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(part->first_row[e]),
                          values.begin() + static_cast<std::ptrdiff_t>(part->first_row[e + 1]),
                          0.0) /
          static_cast<double>(part->first_row[e + 1] - part->first_row[e]));
  }
  if (!std::all_of(means.begin(), means.end(), [](double x) { return std::isfinite(x); }))
    return {};
  Factor factor{state.name, {}, 0, {}};
  for (double& mean : means) {
    factor.texts.push_back(fmt::format("{}", mean));
    if (state.log_axis && mean > 0) mean = std::log(mean);
  }
  ClearLevels levels = clear_levels(means, 0);
  if (levels.count < 2) return {};
  factor.of = std::move(levels.of);
  factor.count = levels.count;
  return factor;
}

// Words and numbers of a text: "base", "4" and "mpa" of "Base_4MPa".
std::vector<std::string> pieces_of(const std::string& text) {
  std::vector<std::string> pieces;
  int before = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const int kind = std::isdigit(byte) || c == '.'       ? 1
                     : std::isalpha(byte) || byte >= 0x80 ? 2
                                                          : 0;
    if (kind != 0 && kind != before) pieces.emplace_back();
    if (kind != 0) pieces.back() += static_cast<char>(std::tolower(byte));
    before = kind;
  }
  return pieces;
}

// Whether the name's text of every test holds the factor's: a word, or a number to within a tenth.
bool is_named_in(const Factor& name, const Factor& factor) {
  constexpr double near = 0.1;
  for (std::size_t e = 0; e < name.of.size(); ++e) {
    const std::vector<std::string> there = pieces_of(name.texts[e]);
    double number = 0;
    const char* const end = factor.texts[e].data() + factor.texts[e].size();
    const auto read = std::from_chars(factor.texts[e].data(), end, number);
    const bool is_number = read.ec == std::errc() && read.ptr == end;
    const auto holds = [&](const std::string& piece) {
      return std::find(there.begin(), there.end(), piece) != there.end();
    };
    const auto is_near = [&](const std::string& piece) {
      double value = 0;
      return std::from_chars(piece.data(), piece.data() + piece.size(), value).ec == std::errc() &&
             std::abs(value - number) <= near * std::abs(number);
    };
    const std::vector<std::string> own = pieces_of(factor.texts[e]);
    if (is_number ? std::none_of(there.begin(), there.end(), is_near)
                  : own.empty() || !std::all_of(own.begin(), own.end(), holds))
      return false;
  }
  return true;
}

// Whether each level of `name` has one level of the factor.
bool has_one_each(const Factor& name, const Factor& factor) {
  std::map<std::size_t, std::size_t> level;
  for (std::size_t e = 0; e < name.of.size(); ++e)
    if (level.emplace(name.of[e], factor.of[e]).first->second != factor.of[e]) return false;
  return factor.count < name.count;
}

std::size_t count_combinations(const std::vector<const Factor*>& factors) {
  std::set<std::vector<std::size_t>> all;
  for (std::size_t e = 0; e < factors.front()->of.size(); ++e) {
    std::vector<std::size_t> at;
    for (const Factor* factor : factors)
      at.push_back(factor->of[e]);
    all.insert(std::move(at));
  }
  return all.size();
}

// The settings whose combinations a column names, if its own name or its texts say so: one level
// for each combination. Empty otherwise, as for a lubricant that was tried at one load alone.
std::vector<std::string> named_combination(const Factor& column, bool is_text,
                                           const std::vector<Factor>& factors) {
  std::vector<const Factor*> refined, in_texts;
  for (const Factor& factor : factors) {
    if (factor.name == column.name || !has_one_each(column, factor)) continue;
    refined.push_back(&factor);
    if (is_text && is_named_in(column, factor)) in_texts.push_back(&factor);
  }
  const bool by_name = has_match(combination_names, plain_name(column.name));
  for (const auto& some : {in_texts, by_name ? refined : in_texts}) {
    if (some.size() < 2 || count_combinations(some) != column.count) continue;
    std::vector<std::string> names;
    for (const Factor* factor : some)
      names.push_back(factor->name);
    return names;
  }
  return {};
}

// Ignores columns that name combinations of the others.
void ignore_names_of_combinations(std::span<Dataset* const> parts) {
  std::vector<Factor> factors;
  for (const Column& column : parts.front()->columns) {
    const Quantity* const state = find_quantity(column.name);
    const bool is_state = state && state->state && column.name != "s_mm";
    if (!is_state && column.role != Role::label && column.role != Role::setting) continue;
    if (auto factor = is_state ? factor_of_state(parts, *state) : factor_of(parts, column.name))
      factors.push_back(std::move(*factor));
  }
  for (const Factor& factor : factors) {
    const Column& column = *parts.front()->find(factor.name);
    if (find_quantity(column.name) || column.why == set_by_job) continue;
    const std::vector<std::string> names =
        named_combination(factor, !column.levels.empty(), factors);
    if (!names.empty()) ignore(parts, factor.name, "names combinations of " + join(names, ", "));
  }
}

} // namespace

void ignore_repeated_columns(std::span<Dataset* const> parts) {
  ignore_copies(parts);
  ignore_names_of_combinations(parts);
}

} // namespace frictab::data
