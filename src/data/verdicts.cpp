// Recognises verdicts by the column's name and by its texts.
#include "data/verdicts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "core/pattern.h"
#include "core/text.h"
#include "data/name_words.h"
#include "expr/expr.h"

namespace frictab::data {

namespace {

// Names and texts of a verdict on a test, which somebody passed on it when it was over.
constexpr const char* verdict_names =
    "^((is|test|run|versuch|messung|data)_)?"
    "(in|un)?(valid(ity|ated)?|g\\S*ltig(keit)?|usable|verwendbar|brauchbar|accept(ed|able)?|"
    "pass(ed)?|fail(ed)?|ok|n?io|outlier|ausrei\\S*er|excluded?|reject(ed)?|discard(ed)?|"
    "use(_it)?|do_not_use)(_(test|run|versuch|flag|status))?$";
constexpr const char* judged_names =
    "verdict|urteil|bewertung|befund|status|quality|qualit|check|flag|rating|result|ergebnis";
constexpr const char* remark_of_the_bad = "do not use|don't use|not valid|invalid|discard|nicht "
                                          "(verwenden|verwertbar)|ung\\S*ltig|verwerfen";
constexpr const char* names_of_the_bad = // true of a test that failed
    "^(\\w+_)?(in|un)(valid|g\\S*ltig|usable|brauchbar)|fail|outlier|ausrei|exclude|reject|discard|"
    "do_not_use";
constexpr std::array yes_words{"true", "yes", "ja", "y", "j", "1", "x", "wahr"};
constexpr std::array no_words{"false", "no", "nein", "n", "0", "falsch", "-"};
constexpr std::array good_words{"ok",          "i.o.",    "i.o",  "io",     "i. o.",    "valid",
                                "g\u00fcltig", "gueltig", "pass", "passed", "accepted", "use"};
constexpr std::array bad_words{
    "nok",    "n.ok",     "not ok",     "not o.k.",      "n.i.o.",    "n.i.o",
    "nio",    "n. i. o.", "invalid",    "ung\u00fcltig", "ungueltig", "fail",
    "failed", "rejected", "do not use", "not valid",     "excluded",  "nicht verwenden"};
// A surface may be good or bad as well: only of a column that is named like a verdict.
constexpr std::array good_or_bad{"good", "gut", "bad", "schlecht"};

template <class Words> bool is_one_of(const Words& words, const std::string& text) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

// The texts of a verdict on tests that are bad; nullopt for another column.
std::optional<std::set<std::string>> bad_of_verdict(const std::string& name,
                                                    const std::set<std::string>& texts) {
  constexpr std::size_t most = 3; // with an empty cell
  const std::string plain = plain_name(name);
  if (texts.size() < 2 || texts.size() > most) return {};
  const bool named = has_match(verdict_names, plain),
             of_the_bad = has_match(names_of_the_bad, plain),
             judged = named || has_match(judged_names, plain);
  std::set<std::string> bad;
  std::size_t answers = 0;
  for (const std::string& text : texts) {
    const std::string word = lower_case(trimmed(text));
    const bool is_yes = is_one_of(yes_words, word), is_no = is_one_of(no_words, word);
    const bool graded = judged && is_one_of(good_or_bad, word);
    if (is_one_of(bad_words, word) || (graded && (word == "bad" || word == "schlecht")) ||
        (named && (of_the_bad ? is_yes : is_no)))
      bad.insert(text);
    answers += is_yes || is_no;
    if (!word.empty() && !is_yes && !is_no && !graded && !is_one_of(good_words, word) &&
        !is_one_of(bad_words, word))
      return {};
  }
  if (bad.empty() || (!named && answers > 0)) return {};
  return bad;
}

// Texts of a column while they are few; its numbers only if it is named like a verdict.
std::set<std::string> texts_of(const Column& column) {
  constexpr std::size_t few = 4;
  if (column.levels.empty() && !has_match(verdict_names, plain_name(column.name))) return {};
  std::set<double> values;
  for (std::size_t i = 0; i < column.values.size() && values.size() < few; ++i)
    if (!std::isnan(column.values[i])) values.insert(column.values[i]);
  std::set<std::string> texts;
  for (const double value : values)
    texts.insert(column.levels.empty() ? shortest(value)
                                       : column.levels[static_cast<std::size_t>(value)]);
  return texts;
}

std::set<std::string> texts_of(std::span<Dataset* const> parts, const std::string& name) {
  std::set<std::string> texts;
  for (const Dataset* part : parts)
    if (const Column* column = part->find(name)) texts.merge(texts_of(*column));
  return texts;
}

// The texts of a verdict, or of remarks, on tests that are bad.
std::set<std::string> bad_texts(std::span<Dataset* const> parts, const std::string& name) {
  if (auto bad = bad_of_verdict(name, texts_of(parts, name))) return *bad;
  const Pattern remark(remark_of_the_bad, {});
  std::set<std::string> bad;
  for (const Dataset* part : parts)
    if (const Column* column = part->find(name))
      for (const std::string& level : column->levels)
        if (remark.search(lower_case(level))) bad.insert(level);
  return bad;
}

} // namespace

bool is_verdict(const Column& column) {
  return bad_of_verdict(column.name, texts_of(column)).has_value();
}

bool is_verdict(std::span<Dataset* const> parts, const std::string& name) {
  return bad_of_verdict(name, texts_of(parts, name)).has_value();
}

void report_bad_tests(std::span<Dataset* const> parts, const std::string& name) {
  const std::set<std::string> bad = bad_texts(parts, name);
  std::vector<std::string> tests, quoted;
  for (const std::string& text : bad)
    quoted.push_back("\"" + text + "\"");
  for (const Dataset* part : parts)
    if (const Column* column = part->find(name))
      for (std::size_t e = 0; e < part->experiments.size(); ++e) {
        const auto begin = column->values.begin() + static_cast<long>(part->first_row[e]),
                   end = column->values.begin() + static_cast<long>(part->first_row[e + 1]);
        if (std::any_of(begin, end, [&](double value) {
              return column->levels.empty()
                         ? bad.count(shortest(value)) > 0
                         : bad.count(column->levels[static_cast<std::size_t>(value)]) > 0;
            }))
          tests.push_back(part->experiments[e]);
      }
  if (tests.empty()) return;
  constexpr std::size_t shown = 3;
  const std::size_t more = tests.size() - std::min(tests.size(), shown);
  tests.resize(tests.size() - more);
  const std::string key = expr::is_name(name) ? name : "\"" + name + "\"";
  parts.front()->implausible.push_back(
      fmt::format("{} is {} in '{}'{}: judged to be bad, and used; data.drop = {{ {} = [{}] }} "
                  "leaves such rows "
                  "out",
                  name, join(quoted, " or "), join(tests, "', '"), and_more(more, "test"), key,
                  join(quoted, ", ")));
}

} // namespace frictab::data
