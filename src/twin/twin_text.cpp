// Reads "key=value" lists.
#include "twin/twin_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/no_value.h"
#include "core/text.h"

namespace frictab::twin {

static std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (true) {
    const auto end = text.find(separator);
    parts.emplace_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::vector<KeyValue> read_pairs(std::string_view text, char separator, const std::string& option,
                                 std::span<const std::string> known, FaultList& faults) {
  std::vector<KeyValue> pairs;
  for (const std::string& part : split(text, separator)) {
    if (part.empty()) continue;
    const auto equals = part.find('=');
    if (equals == std::string::npos) {
      faults.add({option}, "'" + part + "' is not key=value",
                 "keys: " + join({known.data(), known.size()}, ", "));
      continue;
    }
    KeyValue item{std::string(trimmed(std::string_view(part).substr(0, equals))),
                  std::string(trimmed(std::string_view(part).substr(equals + 1))), option};
    const auto same = [&](const KeyValue& other) { return other.key == item.key; };
    if (std::ranges::find(known, item.key) == known.end())
      faults.add({option}, "unknown key '" + item.key + "'", suggest(item.key, known));
    else if (item.value.empty())
      faults.add({option}, "'" + item.key + "' has no value");
    else if (std::ranges::any_of(pairs, same))
      faults.add({option}, "'" + item.key + "' is given twice");
    else
      pairs.push_back(std::move(item));
  }
  return pairs;
}

double read_number(const KeyValue& item, FaultList& faults) {
  double value = 0;
  const char* end = item.value.data() + item.value.size();
  const auto [stop, error] = std::from_chars(item.value.data(), end, value);
  if (error == std::errc() && stop == end && std::isfinite(value)) return value;
  faults.add({item.option}, "'" + item.value + "' of '" + item.key + "' is not a finite number",
             "write it like 0.15 or 1e-3");
  return no_value;
}

std::vector<double> read_numbers(const KeyValue& item, FaultList& faults) {
  std::vector<double> values;
  for (const std::string& part : split(item.value, ','))
    values.push_back(read_number({item.key, part, item.option}, faults));
  return values;
}

} // namespace frictab::twin
