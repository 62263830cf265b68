// The words of C that differ between double and float.
#include "codegen/single_precision.h"

#include <cctype>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "codegen/table_checks.h"
#include "core/error.h"

namespace frictab::codegen {

namespace {

constexpr const char* precision_key = "precision";
constexpr const char* back_to_double = "export.options.precision = \"double\"";

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c));
}

// The number, word or comment that begins here; else one character.
std::size_t length_of(std::string_view code, std::size_t at) {
  if (code.substr(at, 2) == "/*") return code.find("*/", at) + 2 - at;
  std::size_t end = at;
  const bool number = is_digit(code[at]);
  const auto goes_on = [&](char c) {
    if (is_word(c)) return true;
    if (!number) return false;
    return c == '.' || ((c == '-' || c == '+') && code[end - 1] == 'e');
  };
  while (end < code.size() && goes_on(code[end]))
    ++end;
  return std::max<std::size_t>(end - at, 1);
}

std::string single_word(std::string_view word) {
  static const std::map<std::string_view, const char*> words = {
      {"double", "float"}, {"exp", "expf"},   {"log", "logf"},   {"sqrt", "sqrtf"},
      {"sin", "sinf"},     {"tanh", "tanhf"}, {"acos", "acosf"}, {"pow", "powf"}};
  if (is_digit(word[0]) && word.find_first_of(".e") != std::string_view::npos)
    return single_number(std::stod(std::string(word)));
  const auto known = words.find(word);
  return known == words.end() ? std::string(word) : known->second;
}

} // namespace

ExportOption precision_option() {
  return {precision_key,
          {"double", "single"},
          "\"single\": beside the function in double precision a kernel whose table and arithmetic "
          "are float, frictab_tau_R_f32, for solvers in single precision and GPUs; verified like "
          "every source, with a stated bound of its rounding where there is one"};
}

bool wants_single(const ExportRequest& request) {
  return request.said(precision_key) == "single";
}

void check_single_size(const ExportRequest& request) {
  if (wants_single(request)) check_table_size(request.table, 0, std::string(back_to_double) + ", ");
}

float single_value(double value) {
  const auto nearest = static_cast<float>(value);
  if (std::isinf(nearest))
    throw InputError({}, fmt::format("{} is more than single precision can hold", value),
                     back_to_double);
  constexpr float least = std::numeric_limits<float>::min();
  return value != 0 && std::abs(nearest) < least ? std::copysign(least, nearest) : nearest;
}

std::string single_number(double value) {
  std::string text = fmt::format("{}", single_value(value));
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + "f";
}

std::string in_single_precision(std::string_view code) {
  std::string out;
  for (std::size_t at = 0, length = 0; at < code.size(); at += length) {
    length = length_of(code, at);
    out += single_word(code.substr(at, length));
  }
  return out;
}

} // namespace frictab::codegen
