// Shortens texts.
#include "verify/quoted.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab::verify {

namespace {

constexpr std::size_t most_characters = 60;

} // namespace

std::string quoted(std::string_view text, std::string_view other) {
  if (text.size() <= most_characters) return fmt::format("'{}'", text);
  const auto differs = static_cast<std::size_t>(
      std::mismatch(text.begin(), text.end(), other.begin(), other.end()).first - text.begin());
  std::size_t from = differs < most_characters / 2 ? 0 : differs - most_characters / 2;
  while (from > 0 && (text[from] & 0xC0) == 0x80) // within a character of several bytes
    --from;
  const std::string_view part = utf8_start(text.substr(from), most_characters);
  return fmt::format("'{}{}{}'", from > 0 ? "..." : "", part,
                     from + part.size() < text.size() ? "..." : "");
}

} // namespace frictab::verify
