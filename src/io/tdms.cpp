// Reads a TDMS file segment by segment: first what it lists, then the values of its channels. Every
// length is compared with the size of the file before memory is taken.
#include "io/tdms.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "core/units.h"
#include "io/file_streams.h"
#include "io/tdms_format.h"
#include "io/tdms_scales.h"

namespace frictab::io::tdms {

namespace {

constexpr std::uint64_t lead_in_bytes = 28;
constexpr std::size_t bytes_at_once = std::size_t{4} << 20; // of raw data in memory

// Adds `count` values of `size` bytes; a sum that no file can have becomes too_many.
constexpr std::uint64_t too_many = std::uint64_t{1} << 62;
std::uint64_t with_more(std::uint64_t sum, std::uint64_t count, std::uint64_t size) {
  if (sum >= too_many || (size > 0 && count > (too_many - sum) / size)) return too_many;
  return sum + count * size;
}

// The file, with errors that name the offset.
class Bytes {
public:
  Bytes(const std::filesystem::path& file, const std::string& named)
      : in_(file, named), named_(named) {}

  std::uint64_t size() const { return in_.size(); }

  [[noreturn]] void fail(std::uint64_t at, const std::string& what) const {
    throw InputError({named_, 0, 0}, fmt::format("is damaged at byte {}: {}", thousands(at), what),
                     "copy it again, or export it to CSV where it opens");
  }

  // The bytes must be within the file.
  void read(std::uint64_t at, std::span<char> bytes) {
    if (in_.read_at(at, bytes) != bytes.size()) fail(at, "it ends here");
  }

private:
  InputFile in_;
  const std::string& named_;
};

struct Segment {
  std::uint64_t at = 0; // offset of its lead-in
  std::uint32_t contents = 0;
  std::uint64_t metadata = 0, raw = 0, end = 0; // offsets
  bool finished = true;
  bool has(Contents flag) const { return (contents & flag) != 0; }
  bool big_endian() const { return has(is_big_endian); }
};

// Position of a channel's samples in DAQmx raw data.
struct Daqmx {
  bool digital = false;
  std::size_t scalers = 0;
  std::uint32_t buffer = 0, offset = 0;
  std::vector<std::uint32_t> widths; // bytes of a row of each buffer
};

// Values of an object in each chunk of a segment.
struct Index {
  std::uint32_t type = 0;
  std::uint64_t count = 0, bytes = 0;
  std::optional<Daqmx> daqmx;
};

struct Object {
  ObjectPath path;
  Properties properties;
  std::optional<Index> index; // the last one
  bool has_data = false;      // in the current segment
  std::uint32_t type = 0;     // of its values; 0: none so far
  std::string unreadable;     // type that is not read; else empty
  std::vector<double> numbers;
  std::vector<std::string> texts;
  std::optional<Stamp> first_stamp;
};

// The metadata of a segment.
class Metadata {
public:
  Metadata(Bytes& in, const Segment& segment) : in_(in), segment_(segment) {
    bytes_.resize(segment.raw - segment.metadata);
    in.read(segment.metadata, bytes_);
  }

  template <class T> T number() { return load<T>(take(sizeof(T)), segment_.big_endian()); }

  std::string text() {
    const auto size = number<std::uint32_t>();
    return {take(size), size};
  }

  // Objects take at least eight bytes each.
  std::uint32_t count(std::size_t least_bytes) {
    const std::uint64_t at = offset();
    const auto count = number<std::uint32_t>();
    if (count > (bytes_.size() - used_) / least_bytes)
      in_.fail(
          at, fmt::format("it lists {} entries, more than the segment can hold", thousands(count)));
    return count;
  }

  Property property() {
    const std::uint64_t at = offset();
    const auto type = number<std::uint32_t>();
    if (type == type_text) return to_utf8(text());
    if (type == type_stamp) return load_stamp(take(bytes_of(type)), segment_.big_endian());
    if (bytes_of(type) == 0) in_.fail(at, "a property has " + name_of(type));
    const char* const value = take(bytes_of(type));
    if (type == type_complex_single || type == type_complex_double)
      return std::string("a complex number");
    return load_number(value, type, segment_.big_endian());
  }

  std::uint64_t offset() const { return segment_.metadata + used_; }

private:
  const char* take(std::size_t size) {
    if (size > bytes_.size() - used_)
      in_.fail(offset(),
               fmt::format("{} bytes are expected, the metadata of the segment ends after "
                           "{}",
                           thousands(size), thousands(bytes_.size() - used_)));
    const char* const at = bytes_.data() + used_;
    used_ += size;
    return at;
  }

  Bytes& in_;
  const Segment& segment_;
  std::string bytes_;
  std::size_t used_ = 0;
};

class Reader {
public:
  Reader(const std::filesystem::path& file, const std::string& named)
      : in_(file, named), named_(named) {}

  void read() {
    for (std::uint64_t at = 0; at < in_.size();) {
      const Segment segment = lead_in(at);
      if (segment.has(has_metadata) && segment.raw > segment.metadata) read_metadata(segment);
      if (segment.has(has_raw_data)) read_data(segment);
      at = segment.end;
    }
  }

  std::vector<std::unique_ptr<Object>> objects; // in the order of the file
  std::vector<std::string> notes;

private:
  Segment lead_in(std::uint64_t at) {
    if (in_.size() - at < lead_in_bytes) in_.fail(at, "the file ends within a segment's lead-in");
    std::array<char, lead_in_bytes> bytes{};
    in_.read(at, bytes);
    if (at == 0 && std::string_view(bytes.data(), 4) == "TDSh")
      throw InputError({named_, 0, 0}, "is the index of a TDMS file, without its data",
                       "give the file .tdms that it belongs to");
    if (std::string_view(bytes.data(), 4) != "TDSm")
      in_.fail(at, "no segment starts there, where the one before ends");
    Segment segment;
    segment.at = at;
    segment.contents = load<std::uint32_t>(&bytes[4], false); // in this order in all files
    const auto version = load<std::uint32_t>(&bytes[8], segment.big_endian());
    if (version != 4712 && version != 4713)
      in_.fail(at, fmt::format("version {} of the format is neither 4712 nor 4713", version));
    const auto next = load<std::uint64_t>(&bytes[12], segment.big_endian());
    const auto raw = load<std::uint64_t>(&bytes[20], segment.big_endian());
    segment.metadata = at + lead_in_bytes;
    set_end(segment, next, raw);
    return segment;
  }

  void set_end(Segment& segment, std::uint64_t next, std::uint64_t raw) {
    const std::uint64_t left = in_.size() - segment.metadata;
    segment.finished = next != unknown_offset;
    if (segment.finished && next > left)
      in_.fail(segment.at,
               fmt::format("the segment has {} bytes after its lead-in, the file ends after {}",
                           thousands(next), thousands(left)));
    segment.end = segment.finished ? segment.metadata + next : in_.size();
    if (!segment.finished && raw > segment.end - segment.metadata) {
      notes.push_back("the last segment was not finished: its list of channels is incomplete, and "
                      "it has no values");
      segment.contents = 0;
      raw = 0;
    }
    if (raw > segment.end - segment.metadata)
      in_.fail(segment.at, fmt::format("its raw data would start after byte {} of the segment, "
                                       "which has {}",
                                       thousands(raw), thousands(segment.end - segment.metadata)));
    segment.raw = segment.metadata + raw;
  }

  // ---- metadata ----

  void read_metadata(const Segment& segment) {
    if (segment.has(has_new_list)) {
      for (Object* object : list_)
        object->has_data = false;
      list_.clear();
    }
    Metadata in(in_, segment);
    constexpr std::size_t bytes_of_an_object = 12, bytes_of_a_property = 9;
    for (std::uint32_t left = in.count(bytes_of_an_object); left > 0; --left) {
      Object& object = object_at(in);
      read_index(in, segment, object);
      for (std::uint32_t more = in.count(bytes_of_a_property - 1); more > 0; --more) {
        const std::string name = to_utf8(in.text());
        object.properties[name] = in.property();
      }
    }
  }

  Object& object_at(Metadata& in) {
    const std::uint64_t at = in.offset();
    const std::string path = in.text();
    const auto [known, is_new] = number_of_.emplace(path, objects.size());
    if (!is_new) return *objects[known->second];
    const auto parsed = parse_path(path);
    if (!parsed) in_.fail(at, fmt::format("'{}' is not the path of an object", path));
    Object& object = *objects.emplace_back(std::make_unique<Object>());
    object.path = {to_utf8(parsed->group), to_utf8(parsed->channel)};
    return object;
  }

  void read_index(Metadata& in, const Segment& segment, Object& object) {
    const std::uint64_t at = in.offset();
    const auto length = in.number<std::uint32_t>();
    if (length == no_index) {
      object.has_data = false;
      return;
    }
    if (length == same_index && !object.index)
      in_.fail(at, "'" + object.path.channel +
                       "' refers to an earlier segment, which has no values "
                       "of it");
    if (length == daqmx_index || length == daqmx_digital_index)
      object.index = read_daqmx(in, length == daqmx_digital_index);
    else if (length != same_index)
      object.index = read_plain_index(in, object);
    if (segment.has(has_daqmx_data) != object.index->daqmx.has_value())
      in_.fail(at, "'" + object.path.channel + "' has another kind of raw data than its segment");
    object.has_data = true;
    if (std::find(list_.begin(), list_.end(), &object) == list_.end()) list_.push_back(&object);
  }

  Index read_plain_index(Metadata& in, const Object& object) {
    const std::uint64_t at = in.offset();
    Index index;
    index.type = in.number<std::uint32_t>();
    const auto dimension = in.number<std::uint32_t>();
    index.count = in.number<std::uint64_t>();
    if (dimension != 1)
      in_.fail(at, fmt::format("'{}' has {} dimensions", object.path.channel, dimension));
    const std::size_t size = bytes_of(index.type);
    if (index.type == type_text)
      index.bytes = in.number<std::uint64_t>();
    else if (size == 0)
      throw InputError({named_, 0, 0},
                       fmt::format("the channel {} has {}, whose size in the file is not known",
                                   name(object), name_of(index.type)),
                       "convert it to double in LabVIEW or DIAdem, or export CSV");
    if (index.type != type_text)
      index.bytes = with_more(0, index.count, size);
    else if (index.count > index.bytes / sizeof(std::uint32_t))
      in_.fail(
          at, fmt::format("the texts of '{}' have no room for their lengths", object.path.channel));
    return index;
  }

  // The first of the channel's scalers; it has one unless the job adds numbers of several wires.
  Index read_daqmx(Metadata& in, bool digital) {
    const std::uint64_t at = in.offset();
    Index index;
    index.daqmx.emplace();
    index.daqmx->digital = digital;
    in.number<std::uint32_t>(); // the type DAQmx raw data
    in.number<std::uint32_t>(); // one dimension
    index.count = in.number<std::uint64_t>();
    constexpr std::size_t bytes_of_a_scaler = 17, bytes_of_a_width = 4;
    index.daqmx->scalers = in.count(bytes_of_a_scaler);
    for (std::size_t i = 0; i < index.daqmx->scalers; ++i) {
      const auto type = in.number<std::uint32_t>(), buffer = in.number<std::uint32_t>(),
                 offset = in.number<std::uint32_t>();
      if (digital)
        in.number<std::uint8_t>();
      else
        in.number<std::uint32_t>(); // format bits
      in.number<std::uint32_t>();   // number of its scale
      if (i == 0) index.type = type_of_daqmx(at, type);
      if (i == 0) index.daqmx->buffer = buffer, index.daqmx->offset = offset;
    }
    const std::uint32_t buffers = in.count(bytes_of_a_width);
    for (std::uint32_t i = 0; i < buffers; ++i)
      index.daqmx->widths.push_back(in.number<std::uint32_t>());
    check_daqmx(at, index);
    return index;
  }

  std::uint32_t type_of_daqmx(std::uint64_t at, std::uint32_t type) const {
    constexpr std::array<std::uint32_t, 6> types = {type_u8,  type_i8,  type_u16,
                                                    type_i16, type_u32, type_i32};
    if (type >= types.size()) in_.fail(at, fmt::format("DAQmx raw data of type {}", type));
    return types[type];
  }

  void check_daqmx(std::uint64_t at, const Index& index) const {
    const Daqmx& daqmx = *index.daqmx;
    if (daqmx.scalers == 0 || daqmx.digital) return; // not read
    if (daqmx.buffer >= daqmx.widths.size() ||
        std::uint64_t{daqmx.offset} + bytes_of(index.type) > daqmx.widths[daqmx.buffer])
      in_.fail(at, "a DAQmx channel is outside its raw data");
  }

  // ---- raw data ----

  static std::string name(const Object& object) {
    return fmt::format("'{}'/'{}'", object.path.group, object.path.channel);
  }

  void read_data(const Segment& segment) {
    std::vector<Object*> with_data;
    for (Object* object : list_)
      if (object->has_data && object->index->count > 0) with_data.push_back(object);
    for (Object* object : with_data)
      check_type(segment, *object);
    const std::uint64_t left = segment.end - segment.raw;
    if (with_data.empty() && left > 0 && segment.finished)
      in_.fail(segment.raw,
               fmt::format("{} bytes of raw data belong to no channel", thousands(left)));
    if (with_data.empty()) return;
    if (segment.has(has_daqmx_data)) return read_daqmx_data(segment, with_data);
    if (segment.has(is_interleaved)) return read_interleaved(segment, with_data);
    std::uint64_t chunk = 0;
    for (const Object* object : with_data)
      chunk = with_more(chunk, object->index->bytes, 1);
    std::uint64_t at = segment.raw;
    for (std::uint64_t n = left / chunk; n > 0; --n)
      for (Object* object : with_data) {
        read_block(segment, at, *object);
        at += object->index->bytes;
      }
    count_lost(segment, at, chunk);
  }

  void check_type(const Segment& segment, Object& object) {
    const auto kind = [](std::uint32_t type) {
      return type == type_text || type == type_stamp ? type : std::uint32_t{type_double};
    };
    const Index& index = *object.index;
    if (object.type != 0 && kind(object.type) != kind(index.type))
      in_.fail(segment.at, fmt::format("the channel {} has {}, and had {} before", name(object),
                                       name_of(index.type), name_of(object.type)));
    object.type = index.type;
    if (index.type == type_complex_single || index.type == type_complex_double)
      object.unreadable = name_of(index.type);
    if (index.daqmx && index.daqmx->digital)
      object.unreadable = "lines of a DAQmx digital input; write them as numbers";
    else if (index.daqmx && index.daqmx->scalers != 1)
      object.unreadable =
          fmt::format("DAQmx raw data of {} signals; log it scaled", index.daqmx->scalers);
  }

  // Bytes after the last whole chunk.
  void count_lost(const Segment& segment, std::uint64_t at, std::uint64_t chunk) {
    if (at == segment.end && segment.finished) return;
    if (segment.finished)
      in_.fail(at, fmt::format("{} bytes of raw data are left, a chunk has {}",
                               thousands(segment.end - at), thousands(chunk)));
    notes.push_back(fmt::format(
        "the last segment was not finished: its whole chunks are read; {} bytes after them, of a "
        "chunk of {}, are lost",
        thousands(segment.end - at), thousands(chunk)));
  }

  void read_block(const Segment& segment, std::uint64_t at, Object& object) {
    const Index& index = *object.index;
    if (!object.unreadable.empty()) return;
    if (index.type == type_text) return read_texts(segment, at, object);
    const std::size_t size = bytes_of(index.type);
    std::string bytes;
    for (std::uint64_t done = 0; done < index.bytes; done += bytes.size()) {
      bytes.resize(std::min<std::uint64_t>(bytes_at_once / size * size, index.bytes - done));
      in_.read(at + done, bytes);
      for (std::size_t i = 0; i < bytes.size(); i += size)
        add(object, bytes.data() + i, segment.big_endian());
    }
  }

  static void add(Object& object, const char* bytes, bool big_endian) {
    if (!object.unreadable.empty()) return;
    if (object.index->type != type_stamp) {
      object.numbers.push_back(load_number(bytes, object.index->type, big_endian));
      return;
    }
    const Stamp stamp = load_stamp(bytes, big_endian);
    if (!object.first_stamp) object.first_stamp = stamp;
    object.numbers.push_back(seconds_between(*object.first_stamp, stamp));
  }

  // Ends of all texts, then the texts.
  void read_texts(const Segment& segment, std::uint64_t at, Object& object) {
    const Index& index = *object.index;
    std::string bytes(index.bytes, '\0');
    in_.read(at, bytes);
    const std::string_view all =
        std::string_view(bytes).substr(index.count * sizeof(std::uint32_t));
    std::uint32_t start = 0;
    for (std::uint64_t i = 0; i < index.count; ++i) {
      const auto end =
          load<std::uint32_t>(bytes.data() + i * sizeof(std::uint32_t), segment.big_endian());
      if (end < start || end > all.size())
        in_.fail(at + i * sizeof(std::uint32_t),
                 fmt::format("text {} of the channel {} ends outside its texts", thousands(i + 1),
                             name(object)));
      object.texts.push_back(to_utf8(all.substr(start, end - start)));
      start = end;
    }
  }

  // One value of each channel, then the next one of each.
  void read_interleaved(const Segment& segment, const std::vector<Object*>& with_data) {
    std::size_t row = 0;
    for (const Object* object : with_data) {
      if (object->index->type == type_text)
        in_.fail(segment.at, fmt::format("the texts of {} are interleaved", name(*object)));
      if (object->index->count != with_data.front()->index->count)
        in_.fail(segment.at, fmt::format("the interleaved channels {} and {} differ in length",
                                         name(*with_data.front()), name(*object)));
      row += bytes_of(object->index->type);
    }
    const std::uint64_t rows = (segment.end - segment.raw) / row;
    for_rows(segment.raw, rows, row, [&](const char* bytes) {
      for (Object* object : with_data) {
        add(*object, bytes, segment.big_endian());
        bytes += bytes_of(object->index->type);
      }
    });
    count_lost(segment, segment.raw + rows * row, row);
  }

  template <class Take>
  void for_rows(std::uint64_t at, std::uint64_t rows, std::size_t row, const Take& take) {
    const std::uint64_t at_once = std::max<std::uint64_t>(1, bytes_at_once / row);
    std::string bytes;
    for (std::uint64_t done = 0; done < rows; done += at_once) {
      bytes.resize(std::min(at_once, rows - done) * row);
      in_.read(at + done * row, bytes);
      for (std::size_t i = 0; i < bytes.size(); i += row)
        take(bytes.data() + i);
    }
  }

  // The raw buffers, each with a row of bytes per sample.
  void read_daqmx_data(const Segment& segment, const std::vector<Object*>& with_data) {
    const Index& first = *with_data.front()->index;
    for (const Object* object : with_data)
      if (object->index->count != first.count ||
          object->index->daqmx->widths != first.daqmx->widths)
        in_.fail(segment.at, fmt::format("the DAQmx channels {} and {} differ in their raw data",
                                         name(*with_data.front()), name(*object)));
    std::uint64_t chunk = 0;
    for (const std::uint32_t width : first.daqmx->widths)
      chunk = with_more(chunk, first.count, width);
    if (chunk == 0) in_.fail(segment.at, "its DAQmx raw data have no bytes");
    std::uint64_t at = segment.raw;
    for (std::uint64_t n = (segment.end - segment.raw) / chunk; n > 0; --n)
      for (std::uint32_t buffer = 0; buffer < first.daqmx->widths.size(); ++buffer) {
        const std::uint32_t width = first.daqmx->widths[buffer];
        if (width == 0) continue;
        for_rows(at, first.count, width, [&](const char* bytes) {
          for (Object* object : with_data)
            if (object->unreadable.empty() && object->index->daqmx->buffer == buffer)
              add(*object, bytes + object->index->daqmx->offset, segment.big_endian());
        });
        at += first.count * std::uint64_t{width};
      }
    count_lost(segment, at, chunk);
  }

  Bytes in_;
  const std::string& named_;
  std::map<std::string, std::size_t> number_of_; // by path
  std::vector<Object*> list_;                    // objects of the current segment
};

// ---- as groups of columns ----

bool is_a_time(const Object& channel) {
  const std::string name = lower_case(channel.path.channel);
  for (const char* time : {"time", "time_s", "zeit", "t", "x_value"})
    if (name == time) return true;
  return channel.first_stamp ||
         convert(text_of(channel.properties, "unit_string").value_or(""), "s");
}

struct Waveform {
  double offset, increment;
  bool operator==(const Waveform&) const = default;
};

std::optional<Waveform> waveform_of(const Object& channel) {
  const auto increment = number_of(channel.properties, "wf_increment");
  const std::string unit = text_of(channel.properties, "wf_xunit_string").value_or("s");
  if (!increment || !(*increment > 0) || (!unit.empty() && unit != "s")) return std::nullopt;
  return Waveform{number_of(channel.properties, "wf_start_offset").value_or(0), *increment};
}

class Grouping {
public:
  explicit Grouping(Reader& reader) : reader_(reader) {
    all_.format = "TDMS";
    all_.form = "a TDMS file has one channel per column, in one group or in a group per test";
    all_.one_group_is_file = true;
    all_.notes = reader.notes;
  }

  ColumnGroups groups() {
    for (const auto& object : reader_.objects)
      if (object->path.channel.empty()) add_properties(*object, group(object->path.group));
    for (const auto& object : reader_.objects)
      if (!object->path.channel.empty()) {
        channels_[object->path.group].push_back(object.get());
        group(object->path.group).members.push_back(member(*object));
      }
    for (const auto& [name, channels] : channels_)
      add_time(group(name), channels);
    note("time stamps, read as seconds since the first one: ", stamps_);
    note("raw values, converted by their NI_Scale properties: ", scaled_);
    drop_repeated();
    sort_by_name(all_);
    return std::move(all_);
  }

private:
  ColumnGroup& group(const std::string& name) {
    if (name.empty()) return all_.root;
    const auto [known, is_new] = number_of_.emplace(name, all_.groups.size());
    if (is_new) all_.groups.emplace_back().name = name;
    return all_.groups[known->second];
  }

  static void add_properties(const Object& object, ColumnGroup& to) {
    for (const auto& [name, value] : object.properties) {
      GroupMember one;
      one.name = name;
      one.is_text = !std::holds_alternative<double>(value);
      if (const auto* number = std::get_if<double>(&value))
        one.single = *number;
      else if (const auto* text = std::get_if<std::string>(&value))
        one.single = *text;
      else
        one.single = text_of(std::get<Stamp>(value));
      to.members.push_back(std::move(one));
    }
  }

  GroupMember member(Object& channel) {
    const std::string& name = channel.path.channel;
    if (!channel.texts.empty() && channel.unreadable.empty())
      return text_member(name, std::move(channel.texts));
    std::string unit = text_of(channel.properties, "unit_string").value_or("");
    if (channel.first_stamp) {
      stamps_.push_back(name);
      unit = "s";
    }
    const Scales scales(channel.properties);
    if (channel.unreadable.empty()) channel.unreadable = scales.unreadable();
    if (!channel.unreadable.empty()) return without_values(name, unit, channel.unreadable);
    if (channel.numbers.empty()) return without_values(name, unit, "no values");
    if (!scales.empty()) scaled_.push_back(name);
    scales.apply(channel.numbers);
    count_[&channel] = channel.numbers.size();
    return number_member(name, unit, std::move(channel.numbers));
  }

  static GroupMember without_values(const std::string& name, const std::string& unit,
                                    const std::string& why) {
    GroupMember member = number_member(name, unit, {});
    member.other_type = why;
    return member;
  }

  // Adds the column `time` of a waveform.
  void add_time(ColumnGroup& to, const std::vector<Object*>& channels) {
    std::optional<Waveform> shared;
    std::size_t count = 0;
    for (const Object* channel : channels) {
      if (is_a_time(*channel)) return;
      const auto one = waveform_of(*channel);
      if (!one || count_[channel] < 2) continue;
      if (shared && (shared != one || count_[channel] != count)) {
        all_.notes.push_back(fmt::format("the channels of group '{}' differ in wf_increment, "
                                         "wf_start_offset or length: no time is made of them",
                                         to.name));
        return;
      }
      shared = one;
      count = count_[channel];
    }
    if (!shared) return;
    std::vector<double> times(count);
    for (std::size_t i = 0; i < count; ++i)
      times[i] = shared->offset + static_cast<double>(i) * shared->increment;
    to.members.push_back(number_member("time", "s", std::move(times)));
  }

  // Properties that have the name of a channel.
  void drop_repeated() {
    for (ColumnGroup& one : all_.groups) {
      std::map<std::string, std::size_t> last;
      for (std::size_t i = 0; i < one.members.size(); ++i)
        last[one.members[i].name] = i;
      std::vector<GroupMember> kept;
      for (std::size_t i = 0; i < one.members.size(); ++i)
        if (last[one.members[i].name] == i)
          kept.push_back(std::move(one.members[i]));
        else
          one.others.push_back({one.members[i].name, "a property, in addition to the channel"});
      one.members = std::move(kept);
    }
  }

  void note(const std::string& what, std::vector<std::string>& names) {
    if (names.empty()) return;
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    constexpr std::size_t shown = 10;
    const std::size_t more = names.size() > shown ? names.size() - shown : 0;
    names.resize(names.size() - more);
    all_.notes.push_back(what + join(names, ", ") + and_more(more, "channel"));
  }

  Reader& reader_;
  ColumnGroups all_;
  std::map<std::string, std::size_t> number_of_;
  std::map<std::string, std::vector<Object*>> channels_;
  std::map<const Object*, std::size_t> count_; // numbers of each channel
  std::vector<std::string> stamps_, scaled_;   // names of channels
};

} // namespace

} // namespace frictab::io::tdms

namespace frictab::io {

bool looks_like_tdms(const std::filesystem::path& file) {
  const std::string start = first_bytes(file, 4);
  return start == "TDSm" || start == "TDSh";
}

ColumnGroups read_tdms(const std::filesystem::path& file, const std::string& named) {
  tdms::Reader reader(file, named);
  reader.read();
  return tdms::Grouping(reader).groups();
}

} // namespace frictab::io
