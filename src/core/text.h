// Small text helpers shared by messages, tables and generated code.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frictab {

// The candidate with the smallest edit distance (transpositions count 1), or "" where none is near
// enough to be a typing error (distance > 1 + a third of the length). Where no one is within 2, the
// first candidate that `name` begins goes before.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

// "did you mean 'x'?" where one is near; otherwise "known: a, b, c".
std::string suggest(std::string_view name, std::span<const std::string> candidates);

// ASCII letters only.
std::string lower_case(std::string_view text);

// Digits count as numbers: step 2 before step 10. Texts of the same numbers as bytes.
bool natural_less(std::string_view a, std::string_view b);

std::string join(std::span<const std::string> parts, std::string_view separator);

// Bytes of the well-formed UTF-8 sequence at the front (RFC 3629); 0 where there is none.
std::size_t utf8_length(std::string_view text);

// Of UTF-8 text: how many places it takes in a column (combining and wide letters are not told).
std::size_t characters(std::string_view text);

// The beginning of the text of at most so many bytes that cuts no UTF-8 sequence.
std::string_view utf8_start(std::string_view text, std::size_t bytes);

// For a terminal: control characters but line ends and tabs, and bytes that are no UTF-8, become
// "\\x1b". What a file says reaches people as text, and moves no cursor.
std::string printable(std::string_view text);

// As a shell reads it back as one word: as it is where it is plain, else in quotes.
std::string shell_word(const std::string& text);

std::string replace_all(std::string text, std::string_view from, std::string_view to);

// Shortest text that reads back to the same bits: 0.1, 1e-20, nan, inf.
std::string shortest(double value);

// 44550 -> "44,550".
std::string thousands(std::size_t value);

// " (and 1,200 more rows)"; nothing for 0.
std::string and_more(std::size_t count, std::string_view noun);

// 1536 -> "1.5 KiB".
std::string human_bytes(double bytes);

} // namespace frictab
