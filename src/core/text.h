// Small text helpers shared by messages, tables and generated code.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frictab {

// The candidate with the smallest edit distance (a transposition counts 1), or "" if none is near
// enough to be a typing error (distance > 1 + a third of the length). If no candidate is within 2,
// the first one that starts with `name` takes precedence.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

// "did you mean 'x'?" if a candidate is near; otherwise "known: a, b, c".
std::string suggest(std::string_view name, std::span<const std::string> candidates);

// Lower-cases ASCII letters only.
std::string lower_case(std::string_view text);

// Orders digits as numbers: step 2 before step 10. Texts with equal numbers are ordered by bytes.
bool natural_less(std::string_view a, std::string_view b);

// Without the blanks, tabs and line ends at both ends.
std::string_view trimmed(std::string_view text);

std::string join(std::span<const std::string> parts, std::string_view separator);

// Length in bytes of the well-formed UTF-8 sequence at the front (RFC 3629); 0 if there is none.
std::size_t utf8_length(std::string_view text);

// The text itself if it is UTF-8; otherwise taken as Latin-1, the encoding of older measuring
// programs.
std::string to_utf8(std::string_view text);

// Display width of UTF-8 text; counts combining and wide characters as one.
std::size_t characters(std::string_view text);

// The longest beginning of the text of at most `bytes` bytes that splits no UTF-8 sequence.
std::string_view utf8_start(std::string_view text, std::size_t bytes);

// Text that is safe to print on a terminal: control characters other than line ends and tabs, and
// bytes that are not UTF-8, become "\\x1b". Text from a file therefore cannot move the cursor.
std::string printable(std::string_view text);

// Text that a shell reads as one word: unchanged if plain, otherwise quoted.
std::string shell_word(const std::string& text);

std::string replace_all(std::string text, std::string_view from, std::string_view to);

// Shortest text that reads back to the same bits: 0.1, 1e-20, nan, inf.
std::string shortest(double value);

// Rounds to three significant digits, never below the value: the form in which a bound is shown.
double rounded_up(double value);

// Formats 44550 as "44,550".
std::string thousands(std::size_t value);

// " (and 1,200 more rows)"; "" for 0.
std::string and_more(std::size_t count, std::string_view noun);

// Formats 1536 as "1.5 KiB".
std::string human_bytes(double bytes);

} // namespace frictab
