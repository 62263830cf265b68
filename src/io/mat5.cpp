// MATLAB files of version 4 to 7, by libmatio.
#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <matio.h>
#include <zlib.h>

#include "core/text.h"
#include "io/file_streams.h"
#include "io/mat_value.h"

namespace frictab::io::mat5 {

namespace {

using Kind = MatValue::Kind;

template <class T> std::vector<double> numbers_as(const void* data, std::size_t count) {
  const T* const first = static_cast<const T*>(data);
  std::vector<double> numbers(count);
  std::transform(first, first + count, numbers.begin(),
                 [](T value) { return static_cast<double>(value); });
  return numbers;
}

// The library converts what the file stores to the type of the class.
std::vector<double> numbers_of(const matvar_t& variable, std::size_t count) {
  const void* const data = variable.data;
  switch (variable.class_type) {
  case MAT_C_SINGLE:
    return numbers_as<float>(data, count);
  case MAT_C_INT8:
    return numbers_as<std::int8_t>(data, count);
  case MAT_C_UINT8:
    return numbers_as<std::uint8_t>(data, count);
  case MAT_C_INT16:
    return numbers_as<std::int16_t>(data, count);
  case MAT_C_UINT16:
    return numbers_as<std::uint16_t>(data, count);
  case MAT_C_INT32:
    return numbers_as<std::int32_t>(data, count);
  case MAT_C_UINT32:
    return numbers_as<std::uint32_t>(data, count);
  case MAT_C_INT64:
    return numbers_as<std::int64_t>(data, count);
  case MAT_C_UINT64:
    return numbers_as<std::uint64_t>(data, count);
  default:
    return numbers_as<double>(data, count);
  }
}

std::size_t size_of_class(matio_classes kind) {
  switch (kind) {
  case MAT_C_DOUBLE:
  case MAT_C_INT64:
  case MAT_C_UINT64:
    return 8;
  case MAT_C_SINGLE:
  case MAT_C_INT32:
  case MAT_C_UINT32:
    return 4;
  case MAT_C_INT16:
  case MAT_C_UINT16:
    return 2;
  case MAT_C_INT8:
  case MAT_C_UINT8:
    return 1;
  default:
    return 0;
  }
}

std::vector<std::string> texts_of(const matvar_t& variable, const std::vector<std::size_t>& dims) {
  const std::size_t width = static_cast<std::size_t>(std::max(variable.data_size, 1)),
                    count = variable.nbytes / width;
  std::vector<char16_t> characters(count);
  const char* const bytes = static_cast<const char*>(variable.data);
  bool ascii = true;
  for (std::size_t i = 0; i < count; ++i) {
    if (width == 2) {
      std::memcpy(&characters[i], bytes + 2 * i, 2);
    } else {
      characters[i] = static_cast<unsigned char>(bytes[i * width]);
      ascii = ascii && characters[i] < 0x80;
    }
  }
  const bool one_row = !dims.empty() && dims.front() == 1;
  if (width == 1 && !ascii && one_row) return {to_utf8({bytes, count})};
  return rows_of_text(dims, characters);
}

class Reader {
public:
  explicit Reader(std::uint64_t file_bytes) : file_bytes_(file_bytes) {}

  MatValue value(const matvar_t* variable, int depth) {
    MatValue out;
    if (!variable) return empty();
    out.name = variable->name ? to_utf8(variable->name) : "";
    for (int i = 0; variable->dims && i < variable->rank; ++i)
      out.dims.push_back(variable->dims[i]);
    const std::size_t count = out.dims.empty() ? 0 : count_of(out.dims, file_bytes_);
    out.other = other(*variable);
    if (out.other.empty() && depth > deepest_nesting) out.other = too_deep;
    if (!out.other.empty()) return out;
    if (variable->class_type == MAT_C_STRUCT)
      add_structs(*variable, count, depth, out);
    else if (variable->class_type == MAT_C_CELL)
      add_cells(*variable, count, depth, out);
    else
      add_data(*variable, count, out);
    return out;
  }

private:
  static MatValue empty() {
    MatValue out;
    out.kind = Kind::numbers;
    out.dims = {0, 0};
    return out;
  }

  static std::string other(const matvar_t& variable) {
    if (variable.isComplex) return "complex numbers";
    switch (variable.class_type) {
    case MAT_C_SPARSE:
      return "a sparse matrix";
    case MAT_C_FUNCTION:
      return "a function handle";
    case MAT_C_OBJECT:
    case MAT_C_OPAQUE:
      return is_an_object;
    default:
      return "";
    }
  }

  void add_structs(const matvar_t& variable, std::size_t count, int depth, MatValue& out) {
    out.kind = Kind::structs;
    out.in_order = true;
    auto* const whole = const_cast<matvar_t*>(&variable); // the library's interface
    const unsigned fields = Mat_VarGetNumberOfFields(whole);
    char* const* const names = Mat_VarGetStructFieldnames(&variable);
    if (!variable.data && count * fields > 0) throw MatFault("a struct has no fields");
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<MatValue>& one = out.structs.emplace_back();
      for (unsigned f = 0; f < fields; ++f) {
        one.push_back(value(Mat_VarGetStructFieldByIndex(whole, f, i), depth + 1));
        one.back().name = names && names[f] ? to_utf8(names[f]) : fmt::format("field{}", f + 1);
      }
    }
  }

  void add_cells(const matvar_t& variable, std::size_t count, int depth, MatValue& out) {
    out.kind = Kind::cells;
    if (!variable.data && count > 0) throw MatFault("a cell array has no cells");
    for (std::size_t i = 0; i < count; ++i)
      out.elements.push_back(
          value(Mat_VarGetCell(const_cast<matvar_t*>(&variable), static_cast<int>(i)), depth + 1));
  }

  static void add_data(const matvar_t& variable, std::size_t count, MatValue& out) {
    const bool is_text = variable.class_type == MAT_C_CHAR;
    out.kind = is_text ? Kind::texts : Kind::numbers;
    if (count == 0 || variable.class_type == MAT_C_EMPTY) return;
    if (!variable.data) throw MatFault(fmt::format("the values of '{}' cannot be read", out.name));
    if (is_text) {
      out.texts = texts_of(variable, out.dims);
      return;
    }
    const std::size_t size = size_of_class(variable.class_type);
    if (size == 0) {
      out.kind = Kind::other;
      out.other = fmt::format("values of class {}", static_cast<int>(variable.class_type));
    } else if (variable.nbytes / size < count) {
      throw MatFault(fmt::format("'{}' has fewer values than its size", out.name));
    } else {
      out.numbers = numbers_of(variable, count);
    }
  }

  std::uint64_t file_bytes_;
};

constexpr std::uint64_t tag_bytes = 8; // type and size of an element

// Throws MatFault unless the compressed data are whole; the library does not check them.
void check_compressed(InputFile& in, std::uint64_t at, std::uint64_t size) {
  constexpr std::uint64_t at_once = std::uint64_t{1} << 16;
  std::vector<unsigned char> packed(at_once), unpacked(at_once);
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, inflateEnd);
  int state = Z_OK;
  const std::uint64_t end_of_data = at + size;
  for (std::uint64_t next = at; state == Z_OK && (next < end_of_data || stream.avail_in > 0);) {
    if (stream.avail_in == 0) {
      const std::uint64_t part = std::min(end_of_data - next, at_once);
      if (in.read_at(next, {reinterpret_cast<char*>(packed.data()), part}) != part) break;
      next += part;
      stream.next_in = packed.data();
      stream.avail_in = static_cast<unsigned>(part);
    }
    stream.next_out = unpacked.data();
    stream.avail_out = static_cast<unsigned>(at_once);
    state = inflate(&stream, Z_NO_FLUSH);
  }
  if (state != Z_STREAM_END)
    throw MatFault(
        fmt::format("the compressed variable at byte {} is damaged", thousands(at - tag_bytes)));
}

// Offsets of the variables of a file of version 5 to 7; empty for version 4. The library does not
// distinguish the end of the file from a variable that it cannot read.
std::vector<std::uint64_t> offsets_of(const std::filesystem::path& file, std::uint64_t bytes) {
  constexpr std::uint64_t header = 128, padding = 8, subsystem_at = 116;
  constexpr std::uint32_t compressed = 15;
  InputFile in(file, file.string());
  std::array<char, header> start{};
  const bool is_whole = in.read_at(0, start) == start.size();
  const std::string_view mark(&start[header - 2], 2);
  if (!is_whole || (mark != "IM" && mark != "MI")) return {};
  const auto number = [&](const char* at) {
    std::array<unsigned char, 4> b{};
    std::memcpy(b.data(), at, b.size());
    if (mark == "MI") std::reverse(b.begin(), b.end());
    return std::uint32_t{b[0]} | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 |
           std::uint32_t{b[3]} << 24;
  };
  const std::uint64_t subsystem = number(&start[subsystem_at]);
  std::vector<std::uint64_t> offsets;
  for (std::uint64_t at = header; at < bytes;) {
    std::array<char, tag_bytes> element{};
    const bool is_there = in.read_at(at, element) == element.size();
    const std::uint64_t size = number(&element[4]);
    if (!is_there || size > bytes - at - tag_bytes)
      throw MatFault(fmt::format("the variable at byte {} ends after the file", thousands(at)));
    if (at != subsystem) offsets.push_back(at);
    const bool padded = number(element.data()) != compressed;
    if (!padded) check_compressed(in, at + tag_bytes, size);
    at += tag_bytes + (padded ? (size + padding - 1) / padding * padding : size);
  }
  return offsets;
}

} // namespace

} // namespace frictab::io::mat5

namespace frictab::io {

std::vector<MatValue> read_mat5(const std::filesystem::path& file) {
  const std::uint64_t bytes = std::filesystem::file_size(file);
  const std::vector<std::uint64_t> offsets = mat5::offsets_of(file, bytes);
  const std::unique_ptr<mat_t, int (*)(mat_t*)> in(Mat_Open(file.string().c_str(), MAT_ACC_RDONLY),
                                                   Mat_Close);
  if (!in) throw MatFault("it is not a MATLAB file, or its header is damaged");
  mat5::Reader reader(bytes);
  std::vector<MatValue> variables;
  std::size_t read = 0;
  while (true) {
    const std::unique_ptr<matvar_t, void (*)(matvar_t*)> variable(Mat_VarReadNext(in.get()),
                                                                  Mat_VarFree);
    if (!variable) break;
    ++read;
    MatValue value = reader.value(variable.get(), 0);
    if (!value.name.empty()) variables.push_back(std::move(value));
  }
  if (read < offsets.size())
    throw MatFault(fmt::format("the variable at byte {} cannot be read", thousands(offsets[read])));
  if (variables.empty()) throw MatFault("it holds no variables");
  return variables;
}

} // namespace frictab::io
