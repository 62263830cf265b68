// Decodes values of the TDMS format.
#include "io/tdms_format.h"

#include <chrono>
#include <cmath>

#include <fmt/chrono.h>
#include <fmt/format.h>

namespace frictab::io::tdms {

std::size_t bytes_of(std::uint32_t type) {
  switch (type) {
  case type_i8:
  case type_u8:
  case type_boolean:
    return 1;
  case type_i16:
  case type_u16:
    return 2;
  case type_i32:
  case type_u32:
  case type_single:
  case type_single_unit:
    return 4;
  case type_i64:
  case type_u64:
  case type_double:
  case type_double_unit:
  case type_complex_single:
    return 8;
  case type_stamp:
  case type_complex_double:
    return 16;
  default:
    return 0;
  }
}

std::string name_of(std::uint32_t type) {
  constexpr std::uint32_t type_void = 0, extended = 0x0b, extended_unit = 0x1b, fixed_point = 0x4f;
  switch (type) {
  case type_void:
    return "values without a type";
  case extended:
  case extended_unit:
    return "extended floating-point numbers";
  case fixed_point:
    return "fixed-point numbers";
  case type_text:
    return "texts";
  case type_stamp:
    return "time stamps";
  case type_complex_single:
  case type_complex_double:
    return "complex numbers";
  default:
    return bytes_of(type) > 0 ? "numbers" : fmt::format("values of type {:#x}", type);
  }
}

double seconds_between(const Stamp& from, const Stamp& to) {
  // unsigned differences wrap around instead of overflowing
  const auto seconds = static_cast<std::int64_t>(static_cast<std::uint64_t>(to.seconds) -
                                                 static_cast<std::uint64_t>(from.seconds));
  const double unit = std::ldexp(1.0, -64);
  const double fraction = to.fraction >= from.fraction
                              ? static_cast<double>(to.fraction - from.fraction) * unit
                              : -(static_cast<double>(from.fraction - to.fraction) * unit);
  return static_cast<double>(seconds) + fraction;
}

std::string text_of(const Stamp& stamp) {
  constexpr std::int64_t from_1904_to_1970 = 2'082'844'800, year_10000 = 253'402'300'800;
  if (stamp.seconds < 0 || stamp.seconds > year_10000)
    return fmt::format("{} s after 1904", stamp.seconds);
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}Z",
                     fmt::gmtime(static_cast<std::time_t>(stamp.seconds - from_1904_to_1970)));
}

Stamp load_stamp(const char* bytes, bool big_endian) {
  const char* const seconds = big_endian ? bytes : bytes + 8;
  const char* const fraction = big_endian ? bytes + 8 : bytes;
  return {load<std::int64_t>(seconds, big_endian), load<std::uint64_t>(fraction, big_endian)};
}

double load_number(const char* bytes, std::uint32_t type, bool big_endian) {
  switch (type) {
  case type_i8:
    return load<std::int8_t>(bytes, big_endian);
  case type_i16:
    return load<std::int16_t>(bytes, big_endian);
  case type_i32:
    return load<std::int32_t>(bytes, big_endian);
  case type_i64:
    return static_cast<double>(load<std::int64_t>(bytes, big_endian));
  case type_u8:
    return load<std::uint8_t>(bytes, big_endian);
  case type_u16:
    return load<std::uint16_t>(bytes, big_endian);
  case type_u32:
    return load<std::uint32_t>(bytes, big_endian);
  case type_u64:
    return static_cast<double>(load<std::uint64_t>(bytes, big_endian));
  case type_single:
  case type_single_unit:
    return static_cast<double>(load<float>(bytes, big_endian));
  case type_boolean:
    return load<std::uint8_t>(bytes, big_endian) != 0;
  default:
    return load<double>(bytes, big_endian);
  }
}

std::optional<double> number_of(const Properties& properties, const std::string& name) {
  const auto found = properties.find(name);
  if (found == properties.end()) return std::nullopt;
  const auto* number = std::get_if<double>(&found->second);
  return number ? std::optional(*number) : std::nullopt;
}

std::optional<std::string> text_of(const Properties& properties, const std::string& name) {
  const auto found = properties.find(name);
  if (found == properties.end()) return std::nullopt;
  const auto* text = std::get_if<std::string>(&found->second);
  return text ? std::optional(*text) : std::nullopt;
}

namespace {

// Takes "/'name'" from the front.
std::optional<std::string> take_name(std::string_view& path) {
  if (!path.starts_with("/'")) return std::nullopt;
  std::string name;
  for (std::size_t i = 2; i < path.size(); ++i) {
    if (path[i] != '\'') {
      name += path[i];
    } else if (i + 1 < path.size() && path[i + 1] == '\'') {
      name += path[++i];
    } else {
      path.remove_prefix(i + 1);
      return name.empty() ? std::nullopt : std::optional(name);
    }
  }
  return std::nullopt;
}

} // namespace

std::optional<ObjectPath> parse_path(std::string_view path) {
  ObjectPath out;
  if (path == "/") return out;
  const auto group = take_name(path);
  if (!group) return std::nullopt;
  out.group = *group;
  if (path.empty()) return out;
  const auto channel = take_name(path);
  if (!channel || !path.empty()) return std::nullopt;
  out.channel = *channel;
  return out;
}

} // namespace frictab::io::tdms
