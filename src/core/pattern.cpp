// The only file that uses PCRE2.
#include "core/pattern.h"

#include <array>

#include <fmt/format.h>

#define PCRE2_CODE_UNIT_WIDTH 8
#include <pcre2.h>

namespace frictab {

namespace {

std::string message_of(int code) {
  std::array<PCRE2_UCHAR, 200> text{};
  pcre2_get_error_message(code, text.data(), text.size());
  return reinterpret_cast<const char*>(text.data());
}

// Group names from PCRE2's name table: entries of `size` bytes, the first two of which are the
// group's number.
std::vector<std::string> names_of(const pcre2_code* code) {
  std::uint32_t count = 0, size = 0;
  PCRE2_SPTR table = nullptr;
  pcre2_pattern_info(code, PCRE2_INFO_NAMECOUNT, &count);
  pcre2_pattern_info(code, PCRE2_INFO_NAMEENTRYSIZE, &size);
  pcre2_pattern_info(code, PCRE2_INFO_NAMETABLE, &table);
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < count; ++i)
    names.emplace_back(reinterpret_cast<const char*>(table) + std::size_t(i) * size + 2);
  return names;
}

std::string group(pcre2_match_data* match, const std::string& name) {
  PCRE2_UCHAR* text = nullptr;
  PCRE2_SIZE length = 0;
  if (pcre2_substring_get_byname(match, reinterpret_cast<PCRE2_SPTR>(name.c_str()), &text,
                                 &length) < 0)
    return "";
  const std::string out(reinterpret_cast<const char*>(text), length);
  pcre2_substring_free(text);
  return out;
}

} // namespace

Pattern::Pattern(const std::string& text, const Place& place) : text_(text), place_(place) {
  int error = 0;
  PCRE2_SIZE at = 0;
  pcre2_code* const code = pcre2_compile(reinterpret_cast<PCRE2_SPTR>(text.c_str()), text.size(),
                                         PCRE2_UTF, &error, &at, nullptr);
  if (!code)
    throw InputError(place,
                     fmt::format("'{}' is not a regular expression: {}, at character {}", text,
                                 message_of(error), at + 1),
                     "a group with a name is written (?<name>...); \\d is a digit, \\w a letter, "
                     "digit or _, + one or more of them, and \\. a point");
  code_ = {code, [](void* owned) { pcre2_code_free(static_cast<pcre2_code*>(owned)); }};
  names_ = names_of(code);
}

std::optional<std::map<std::string, std::string>>
Pattern::search(const std::string& subject) const {
  const auto* code = static_cast<const pcre2_code*>(code_.get());
  const std::unique_ptr<pcre2_match_data, decltype(&pcre2_match_data_free)> match(
      pcre2_match_data_create_from_pattern(code, nullptr), pcre2_match_data_free);
  const int found = pcre2_match(code, reinterpret_cast<PCRE2_SPTR>(subject.c_str()), subject.size(),
                                0, 0, match.get(), nullptr);
  if (found == PCRE2_ERROR_NOMATCH) return std::nullopt;
  if (found < 0)
    throw InputError(
        place_,
        fmt::format("'{}' cannot be looked for in '{}': {}", text_, subject, message_of(found)),
        "a simpler pattern: no + or * inside another one");
  std::map<std::string, std::string> groups;
  for (const std::string& name : names_)
    groups[name] = group(match.get(), name);
  return groups;
}

} // namespace frictab
