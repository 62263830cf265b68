// Numbers and names of the TDMS format.
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace frictab::io::tdms {

// Flags of a segment's table of contents.
enum Contents : std::uint32_t {
  has_metadata = 1u << 1,
  has_new_list = 1u << 2,
  has_raw_data = 1u << 3,
  is_interleaved = 1u << 5,
  is_big_endian = 1u << 6,
  has_daqmx_data = 1u << 7,
};

enum Type : std::uint32_t {
  type_i8 = 1,
  type_i16 = 2,
  type_i32 = 3,
  type_i64 = 4,
  type_u8 = 5,
  type_u16 = 6,
  type_u32 = 7,
  type_u64 = 8,
  type_single = 9,
  type_double = 10,
  type_single_unit = 0x19,
  type_double_unit = 0x1a,
  type_text = 0x20,
  type_boolean = 0x21,
  type_stamp = 0x44,
  type_complex_single = 0x08000c,
  type_complex_double = 0x10000d,
};

// Raw data indices with a meaning of their own; any other number is the length of the index.
constexpr std::uint32_t same_index = 0, no_index = 0xffffffff, daqmx_index = 0x1269,
                        daqmx_digital_index = 0x1369;
constexpr std::uint64_t unknown_offset = ~std::uint64_t{0}; // of a segment that was not finished

// Bytes of a value; 0 for texts and for types of unknown size.
std::size_t bytes_of(std::uint32_t type);
// "extended floating-point numbers"; "type 0x4f" for a type without a name.
std::string name_of(std::uint32_t type);

// Seconds since 1904-01-01 UTC, and a fraction in units of 2^-64 s.
struct Stamp {
  std::int64_t seconds = 0;
  std::uint64_t fraction = 0;
};
double seconds_between(const Stamp& from, const Stamp& to);
// "2024-02-06T17:12:08Z"
std::string text_of(const Stamp& stamp);

template <class T> T load(const char* bytes, bool big_endian) {
  char ordered[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i)
    ordered[i] = bytes[big_endian ? sizeof(T) - 1 - i : i];
  T value;
  std::memcpy(&value, ordered, sizeof(T));
  return value;
}

Stamp load_stamp(const char* bytes, bool big_endian);
// A number of bytes_of(type) bytes; booleans are 0 and 1.
double load_number(const char* bytes, std::uint32_t type, bool big_endian);

using Property = std::variant<double, std::string, Stamp>;
using Properties = std::map<std::string, Property>;
std::optional<double> number_of(const Properties& properties, const std::string& name);
std::optional<std::string> text_of(const Properties& properties, const std::string& name);

// Names of "/'group'/'channel'" with doubled quotes as one; nullopt for a malformed path.
struct ObjectPath {
  std::string group, channel; // empty: the file, or a group
};
std::optional<ObjectPath> parse_path(std::string_view path);

} // namespace frictab::io::tdms
