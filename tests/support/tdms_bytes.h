// Segments of TDMS files, byte by byte, from NI's description of the format.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace frictab::test {

class TdmsSegment {
public:
  explicit TdmsSegment(bool big_endian = false) : big_endian_(big_endian) {}

  // An object without values: "/", "/'group'", "/'group'/'channel'".
  TdmsSegment& object(const std::string& path) { return add(path, number(std::uint32_t(-1))); }
  // A channel whose index is that of the segment before.
  TdmsSegment& same(const std::string& path) { return add(path, number(std::uint32_t{0})); }
  // A channel with `count` values of a type in each chunk; `text_bytes`: of texts, with their
  // offsets.
  TdmsSegment& channel(const std::string& path, std::uint32_t type, std::uint64_t count,
                       std::uint64_t text_bytes = 0) {
    std::string index = number(type) + number(std::uint32_t{1}) + number(count);
    if (type == 0x20) index += number(text_bytes);
    return add(path, number(static_cast<std::uint32_t>(index.size() + 4)) + index);
  }
  // A channel of raw DAQmx data: its scaler reads a value of a type at `offset` of each row of
  // `width` bytes.
  TdmsSegment& daqmx(const std::string& path, std::uint64_t count, std::uint32_t type,
                     std::uint32_t offset, std::uint32_t width) {
    flags_ |= 1u << 7;
    std::string index = number(std::uint32_t{0x1269}) + number(std::uint32_t(-1)) +
                        number(std::uint32_t{1}) + number(count) + number(std::uint32_t{1});
    for (const std::uint32_t part : {type, 0u, offset, 0u, 0u})
      index += number(part);
    return add(path, index + number(std::uint32_t{1}) + number(width));
  }

  TdmsSegment& property(const std::string& name, const std::string& value) {
    return property(name, 0x20, text(value));
  }
  TdmsSegment& property(const std::string& name, double value) {
    return property(name, 10, number(value));
  }
  TdmsSegment& property(const std::string& name, std::uint32_t type, const std::string& bytes) {
    ++property_counts_.back();
    properties_.back() += text(name) + number(type) + bytes;
    return *this;
  }

  template <class T> TdmsSegment& values(const std::vector<T>& values) {
    for (const T& value : values)
      raw_ += number(value);
    return *this;
  }
  TdmsSegment& raw(const std::string& bytes) {
    raw_ += bytes;
    return *this;
  }
  TdmsSegment& texts(const std::vector<std::string>& texts) {
    std::string all;
    for (const std::string& one : texts)
      raw_ += number(static_cast<std::uint32_t>((all += one).size()));
    raw_ += all;
    return *this;
  }
  TdmsSegment& interleaved() {
    flags_ |= 1u << 5;
    return *this;
  }
  // Its objects are added to those of the segment before.
  TdmsSegment& continued() {
    flags_ &= ~(1u << 2);
    return *this;
  }
  // As a crash leaves it: without its length.
  TdmsSegment& unfinished() {
    finished_ = false;
    return *this;
  }

  std::string bytes() const {
    std::string metadata;
    if (!objects_.empty()) {
      metadata = number(static_cast<std::uint32_t>(objects_.size()));
      for (std::size_t i = 0; i < objects_.size(); ++i)
        metadata += objects_[i] + number(property_counts_[i]) + properties_[i];
    }
    std::uint32_t flags = flags_ | (raw_.empty() ? 0u : 1u << 3) | (big_endian_ ? 1u << 6 : 0u);
    if (objects_.empty()) flags &= ~((1u << 1) | (1u << 2));
    std::string out = "TDSm";
    for (int i = 0; i < 4; ++i) // little-endian in all files
      out += static_cast<char>(flags >> (8 * i));
    out += number(std::uint32_t{4713});
    out += number(finished_ ? std::uint64_t{metadata.size() + raw_.size()} : std::uint64_t(-1));
    out += number(std::uint64_t{metadata.size()});
    return out + metadata + raw_;
  }

  template <class T> std::string number(T value) const {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    if (big_endian_) std::reverse(bytes.begin(), bytes.end());
    return bytes;
  }
  std::string text(const std::string& value) const {
    return number(static_cast<std::uint32_t>(value.size())) + value;
  }

private:
  TdmsSegment& add(const std::string& path, const std::string& index) {
    objects_.push_back(text(path) + index);
    property_counts_.push_back(0);
    properties_.emplace_back();
    return *this;
  }

  bool big_endian_, finished_ = true;
  std::uint32_t flags_ = (1u << 1) | (1u << 2);
  std::vector<std::string> objects_, properties_;
  std::vector<std::uint32_t> property_counts_;
  std::string raw_;
};

} // namespace frictab::test
