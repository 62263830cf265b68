// Wraps the C API in exceptions and converts the result to bytes.
#include "io/hdf5_scan.h"

#include <algorithm>

#include <fmt/format.h>
#include <hdf5_hl.h>

#include "io/hdf5_guard.h"
#include "io/hdf5_handle.h"

namespace frictab::io {

using namespace hdf5;

namespace {

constexpr std::size_t values_at_once = std::size_t{1} << 20;
constexpr std::uint64_t held_bytes = std::uint64_t{1} << 24; // limit for one dataset
constexpr std::uint64_t held_in_all = std::uint64_t{1} << 28;
constexpr std::size_t longest_text = std::size_t{1} << 20;
constexpr std::uint64_t bytes_of_a_text = 64; // memory of a short text with its overhead
// Best compression ratio of deflate.
constexpr std::uint64_t best_ratio = 1100;

struct Unreadable {
  std::string what, hint;
};

enum Kind : std::uint64_t { is_absent, is_text, is_number }; // tags in the byte stream

// ---- in the child ----

// Number of values, or SIZE_MAX if the file cannot contain that many: a damaged header may claim
// any size, so the claim is refused before allocation.
std::size_t values_of(const std::vector<std::size_t>& shape, std::uint64_t file_bytes) {
  const std::uint64_t limit = file_bytes * best_ratio + 1024;
  std::size_t count = 1;
  for (const std::size_t n : shape) {
    if (n != 0 && count > limit / n) return SIZE_MAX;
    count *= n;
  }
  return count;
}

std::optional<std::string> text_attribute(hid_t attribute) {
  const Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1)
    return std::nullopt;
  if (H5Tis_variable_str(type) > 0) {
    char* raw = nullptr;
    if (H5Aread(attribute, type, &raw) < 0 || raw == nullptr) return std::nullopt;
    std::string text = raw;
    H5free_memory(raw);
    return text;
  }
  std::string text(std::min(H5Tget_size(type), longest_text), '\0');
  if (text.size() != H5Tget_size(type) || H5Aread(attribute, type, text.data()) < 0)
    return std::nullopt;
  text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
  return text;
}

// numpy's booleans as h5py writes them: an enumeration of 8 bits, FALSE and TRUE.
bool is_boolean(hid_t type) {
  if (H5Tget_class(type) != H5T_ENUM || H5Tget_size(type) != 1 || H5Tget_nmembers(type) != 2)
    return false;
  for (const auto& [name, wanted] : {std::pair("FALSE", 0), std::pair("TRUE", 1)}) {
    signed char value = -1;
    if (H5Tenum_valueof(type, name, &value) < 0 || value != wanted) return false;
  }
  return true;
}

std::optional<double> number_attribute(hid_t attribute) {
  const Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  const H5T_class_t kind = H5Tget_class(type);
  if (H5Sget_simple_extent_npoints(space) != 1) return std::nullopt;
  if (is_boolean(type)) {
    signed char truth = 0;
    return H5Aread(attribute, type, &truth) < 0 ? std::nullopt : std::optional<double>(truth);
  }
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) return std::nullopt;
  double value = 0;
  if (H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0) return std::nullopt;
  return value;
}

std::string other_attribute(hid_t attribute) {
  const Handle space(H5Aget_space(attribute), H5Sclose);
  const hssize_t values = H5Sget_simple_extent_npoints(space);
  if (values == 0) return "an attribute without a value";
  return values > 1 ? fmt::format("an attribute of {} values", values)
                    : "an attribute that is neither a number nor a text";
}

// Attributes of one text or one number; the rest goes to `others`.
Hdf5Attributes attributes_of(hid_t object, std::vector<Hdf5Other>* others = nullptr) {
  std::vector<std::string> names;
  const auto visit = [](hid_t, const char* name, const H5A_info_t*, void* into) -> herr_t {
    static_cast<std::vector<std::string>*>(into)->push_back(name);
    return 0;
  };
  H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &names);
  Hdf5Attributes attributes;
  for (const std::string& name : names) {
    const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
    if (!attribute.ok()) continue;
    if (auto text = text_attribute(attribute))
      attributes[name] = std::move(*text);
    else if (const auto number = number_attribute(attribute))
      attributes[name] = *number;
    else if (others)
      others->push_back({name, other_attribute(attribute)});
  }
  return attributes;
}

std::optional<std::string> scale_of(hid_t set, std::size_t axis) {
  std::optional<std::string> found;
  const auto visit = [](hid_t, unsigned, hid_t scale, void* into) -> herr_t {
    char name[256] = {};
    if (H5Iget_name(scale, name, sizeof name) > 0)
      *static_cast<std::optional<std::string>*>(into) = std::string(name + (name[0] == '/'));
    return 1; // stops at the first one
  };
  H5DSiterate_scales(set, static_cast<unsigned>(axis), nullptr, visit, &found);
  return found;
}

Hdf5Layout layout_of(hid_t set) {
  const Handle list(H5Dget_create_plist(set), H5Pclose);
  Hdf5Layout out;
  out.stored_bytes = H5Dget_storage_size(set);
  if (H5Pget_layout(list) == H5D_CHUNKED) {
    hsize_t chunk[H5S_MAX_RANK] = {};
    const int rank = H5Pget_chunk(list, H5S_MAX_RANK, chunk);
    out.chunk.assign(chunk, chunk + std::max(rank, 0));
  }
  for (int i = 0; i < H5Pget_nfilters(list); ++i) {
    unsigned flags = 0, options[8] = {};
    std::size_t count = 8;
    char name[64] = {};
    const H5Z_filter_t id = H5Pget_filter2(list, static_cast<unsigned>(i), &flags, &count, options,
                                           sizeof name, name, nullptr);
    out.filters.push_back(id == H5Z_FILTER_DEFLATE ? fmt::format("deflate {}", options[0]) : name);
  }
  return out;
}

// The first filter of a dataset that this library lacks, by its name in the file ("lzf"); else
// empty.
std::string missing_filter(hid_t list) {
  for (int i = 0; i < H5Pget_nfilters(list); ++i) {
    unsigned flags = 0;
    std::size_t options = 0;
    char name[64] = {};
    const H5Z_filter_t id = H5Pget_filter2(list, static_cast<unsigned>(i), &flags, &options,
                                           nullptr, sizeof name, name, nullptr);
    if (H5Zfilter_avail(id) <= 0) return name[0] ? name : fmt::format("number {}", id);
  }
  return "";
}

[[noreturn]] void cannot_read(const std::string& name, hid_t set) {
  const Handle list(H5Dget_create_plist(set), H5Pclose);
  if (const std::string filter = missing_filter(list); !filter.empty())
    throw Unreadable{fmt::format("'{}' cannot be read: it is compressed by the filter {}, which "
                                 "the HDF5 library here does not have",
                                 name, filter),
                     "write it with gzip where that filter is at hand: h5repack -f GZIP=4 OLD NEW, "
                     "or compression=\"gzip\" in h5py"};
  if (H5Pget_nfilters(list) > 0)
    throw Unreadable{"'" + name +
                         "' cannot be read: a chunk does not fit its checksum or its compression",
                     "the file is damaged: write it again, or take a copy"};
  throw Unreadable{"'" + name + "' cannot be read", "the file may be damaged"};
}

std::vector<std::size_t> shape_of(const std::string& name, hid_t set) {
  const Handle space(H5Dget_space(set), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0) throw Unreadable{"the shape of '" + name + "' cannot be read", ""};
  std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
  if (rank > 0) H5Sget_simple_extent_dims(space, dims.data(), nullptr);
  return {dims.begin(), dims.end()};
}

bool is_null(hid_t set) {
  const Handle space(H5Dget_space(set), H5Sclose);
  return H5Sget_simple_extent_type(space) == H5S_NULL;
}

// Selects `count` values from index `first` on of a dataset with one long axis.
void select_rows(hid_t space, hsize_t first, hsize_t count) {
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> dims(static_cast<std::size_t>(std::max(rank, 1)), 1);
  H5Sget_simple_extent_dims(space, dims.data(), nullptr);
  std::vector<hsize_t> start(dims.size(), 0), part(dims.size(), 1);
  const auto is_long = std::find_if(dims.begin(), dims.end(), [](hsize_t n) { return n != 1; });
  const std::size_t axis =
      is_long == dims.end() ? 0 : static_cast<std::size_t>(is_long - dims.begin());
  start[axis] = first;
  part[axis] = count;
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, part.data(), nullptr);
}

// Description of a type that is neither numbers nor texts; else empty.
std::string other_type_of(hid_t type) {
  switch (H5Tget_class(type)) {
  case H5T_FLOAT:
  case H5T_INTEGER:
  case H5T_STRING:
    return "";
  case H5T_ENUM:
    return is_boolean(type) ? "" : "an enumeration";
  case H5T_VLEN:
    return "lists";
  case H5T_ARRAY:
    return "arrays";
  case H5T_REFERENCE:
    return "references";
  case H5T_COMPOUND:
    break;
  default:
    return "bits";
  }
  constexpr int shown = 4;
  std::vector<std::string> fields;
  const int all = H5Tget_nmembers(type);
  for (int i = 0; i < std::min(all, shown); ++i) {
    char* const name = H5Tget_member_name(type, static_cast<unsigned>(i));
    fields.emplace_back(name ? name : "");
    H5free_memory(name);
  }
  return fmt::format("records of {}{}", fmt::join(fields, ", "), all > shown ? ", ..." : "");
}

// `count` values from index `first` on if there is one long axis; otherwise all.
std::vector<std::string> texts_of(const std::string& name, hid_t set, std::size_t first,
                                  std::size_t count) {
  const Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
  const hsize_t n = count;
  const Handle rows(H5Screate_simple(1, &n, nullptr), H5Sclose);
  if (length_of_column(shape_of(name, set))) select_rows(space, first, count);
  const Unreadable bad{"'" + name + "' cannot be read as text", ""};
  std::vector<std::string> texts;
  if (H5Tis_variable_str(type) > 0) {
    const Handle memory(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(memory, H5T_VARIABLE);
    H5Tset_cset(memory, H5Tget_cset(type));
    std::vector<char*> raw(count, nullptr);
    if (count > 0 && H5Dread(set, memory, rows, space, H5P_DEFAULT, raw.data()) < 0) throw bad;
    for (char* text : raw) {
      texts.emplace_back(text ? text : "");
      H5free_memory(text);
    }
    return texts;
  }
  const std::size_t width = H5Tget_size(type);
  if (width == 0 || width > longest_text) throw bad;
  std::string packed(width * count, '\0');
  if (count > 0 && H5Dread(set, type, rows, space, H5P_DEFAULT, packed.data()) < 0) throw bad;
  for (std::size_t i = 0; i < count; ++i) {
    std::string text = packed.substr(i * width, width);
    text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
    texts.push_back(text);
  }
  return texts;
}

void check_numeric(const std::string& name, hid_t set) {
  const Handle type(H5Dget_type(set), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type);
  if (kind != H5T_FLOAT && kind != H5T_INTEGER && !is_boolean(type))
    throw Unreadable{"'" + name + "' is not numeric", ""};
}

// Fills all of `values`. Booleans are converted here because the library does not convert them to
// numbers.
bool read_numbers(hid_t set, hid_t memory, hid_t space, std::vector<double>& values) {
  const Handle type(H5Dget_type(set), H5Tclose);
  if (!is_boolean(type))
    return H5Dread(set, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()) >= 0;
  std::vector<signed char> truths(values.size());
  const bool done = H5Dread(set, type, memory, space, H5P_DEFAULT, truths.data()) >= 0;
  std::copy(truths.begin(), truths.end(), values.begin());
  return done;
}

std::vector<double> numbers_of(const std::string& name, hid_t set, hsize_t first, hsize_t count) {
  check_numeric(name, set);
  const Handle space(H5Dget_space(set), H5Sclose);
  const Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose);
  select_rows(space, first, count);
  std::vector<double> values(count);
  if (count > 0 && !read_numbers(set, memory, space, values)) cannot_read(name, set);
  return values;
}

template <class Take>
void read_values(const std::string& name, hid_t set, const std::vector<std::size_t>& shape,
                 std::size_t most, const Take& take) {
  check_numeric(name, set);
  const Handle space(H5Dget_space(set), H5Sclose);
  const std::vector<hsize_t> dims(shape.begin(), shape.end());
  std::vector<double> values;
  for_blocks(dims, block_shape(dims, most), [&](const auto& start, const auto& part, hsize_t n) {
    values.resize(n);
    const Handle memory(H5Screate_simple(1, &n, nullptr), H5Sclose);
    if (!dims.empty())
      H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, part.data(), nullptr);
    if (!read_numbers(set, memory, space, values)) cannot_read(name, set);
    take(std::span<const double>(values));
  });
}

class Scan {
public:
  explicit Scan(const std::filesystem::path& file)
      : file_(H5Fopen(file.string().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose) {
    if (!file_.ok())
      throw Unreadable{
          "cannot be opened as HDF5",
          "it may be cut short or of another format; write it again, or give a CSV file"};
    try {
      check_in_itself(file_);
    } catch (const Elsewhere& found) {
      throw Unreadable{found.what, found.hint};
    }
    H5Fget_filesize(file_, &bytes_);
  }

  Hdf5Contents contents() {
    Hdf5Contents all;
    add_group(all, "");
    for (const Member& group : members("/"))
      if (group.type == H5I_GROUP) add_group(all, group.name + "/");
    return all;
  }

  void values(const std::string& name, std::size_t most, os::ByteSink& out) const {
    const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
    // for chunks that span several blocks
    H5Pset_chunk_cache(access, 12421, std::size_t{1} << 26, 1);
    const Handle set(opened(name, access), H5Dclose);
    read_values(name, set, shape_of(name, set), most, [&](std::span<const double> values) {
      out.number(values.size());
      out.doubles(values);
    });
  }

  void slice(const Hdf5Slice& wanted, os::ByteSink& out) const {
    const Handle set(opened(wanted.dataset, H5P_DEFAULT), H5Dclose);
    const Handle type(H5Dget_type(set), H5Tclose);
    const std::vector<std::size_t> shape = shape_of(wanted.dataset, set);
    const std::size_t rows = length_of_column(shape).value_or(0);
    if (wanted.first > rows || wanted.count > rows - wanted.first)
      throw Unreadable{"'" + wanted.dataset + "' has another shape now", "the file was changed"};
    const bool as_text = H5Tget_class(type) == H5T_STRING;
    for (std::size_t done = 0; done < wanted.count; done += values_at_once) {
      const std::size_t first = wanted.first + done;
      const std::size_t count = std::min(values_at_once, wanted.count - done);
      Hdf5Values found;
      if (as_text)
        found.texts = texts_of(wanted.dataset, set, first, count);
      else
        found.numbers = numbers_of(wanted.dataset, set, first, count);
      out.number(as_text ? is_text : is_number); // written after everything that can fail
      out.doubles(found.numbers);
      for (const std::string& text : found.texts)
        out.text(text);
    }
  }

private:
  hid_t opened(const std::string& name, hid_t access) const {
    const hid_t set = H5Dopen2(file_, name.c_str(), access);
    if (set < 0) throw Unreadable{"there is no dataset '" + name + "'", ""};
    return set;
  }

  // `group` is a path that ends in /; empty for the root.
  void add_group(Hdf5Contents& all, const std::string& group) {
    const std::string object = group.empty() ? "/" : group.substr(0, group.size() - 1);
    const Handle in(H5Oopen(file_, object.c_str(), H5P_DEFAULT), H5Oclose);
    std::vector<Hdf5Other>& others = all.others[object];
    all.groups[object] = attributes_of(in, &others);
    for (const Member& own : members(object))
      if (own.type == H5I_DATASET)
        all.datasets[group + own.name] = dataset(group + own.name);
      else if (own.type == H5I_BADID)
        others.push_back({own.name, "a link to nothing"});
      else if (own.type == H5I_GROUP && !group.empty())
        others.push_back({own.name, "a group within a group"});
  }

  struct Member {
    std::string name;
    H5I_type_t type; // H5I_BADID: a link to nothing
  };

  std::vector<Member> members(const std::string& group) const {
    std::vector<Member> found;
    const auto visit = [](hid_t in, const char* name, const H5L_info_t*, void* into) -> herr_t {
      const Handle object(H5Oopen(in, name, H5P_DEFAULT), H5Oclose);
      static_cast<std::vector<Member>*>(into)->push_back(
          {name, object.ok() ? H5Iget_type(object) : H5I_BADID});
      return 0;
    };
    const Handle in(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
    if (!in.ok() || H5Literate(in, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &found) < 0)
      throw Unreadable{"its list of datasets cannot be read", "the file may be damaged"};
    return found;
  }

  Hdf5Dataset dataset(const std::string& name) {
    Hdf5Dataset out;
    const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    try {
      if (!set.ok()) throw Unreadable{"there is no dataset '" + name + "'", ""};
      const Handle type(H5Dget_type(set), H5Tclose);
      out.is_text = H5Tget_class(type) == H5T_STRING;
      out.other_type = is_null(set) ? "no value" : other_type_of(type);
      out.shape = shape_of(name, set);
      out.attributes = attributes_of(set);
      for (std::size_t axis = 0; axis < out.shape.size(); ++axis)
        out.scales.push_back(scale_of(set, axis));
      out.layout = layout_of(set);
      add_values(name, set, out);
    } catch (const Unreadable& error) {
      out.fault = error.what;
      out.hint = error.hint;
    }
    return out;
  }

  void add_values(const std::string& name, hid_t set, Hdf5Dataset& out) {
    const std::size_t count = values_of(out.shape, bytes_);
    if (count == SIZE_MAX)
      throw Unreadable{"'" + name + "' claims more values than the file can hold", ""};
    const std::uint64_t needed =
        (out.is_text ? bytes_of_a_text : sizeof(double)) * std::uint64_t{count};
    const bool is_small = needed <= held_bytes && (count == 1 || held_ + needed <= held_in_all);
    if (!is_small && (!out.is_text || length_of_column(out.shape))) return;
    held_ += needed;
    if (out.is_text)
      out.texts = texts_of(name, set, 0, count);
    else if (count > 0)
      read_values(name, set, out.shape, values_at_once, [&](std::span<const double> values) {
        out.values.insert(out.values.end(), values.begin(), values.end());
      });
    out.in_memory = true;
  }

  Handle file_;
  hsize_t bytes_ = 0;
  std::uint64_t held_ = 0;
};

// ---- as bytes ----

void put(os::ByteSink& out, const Hdf5Attributes& attributes) {
  out.number(attributes.size());
  for (const auto& [name, value] : attributes) {
    out.text(name);
    const auto* text = std::get_if<std::string>(&value);
    out.number(text ? is_text : is_number);
    if (text)
      out.text(*text);
    else
      out.doubles({&std::get<double>(value), 1});
  }
}

void put(os::ByteSink& out, const std::vector<std::size_t>& numbers) {
  out.number(numbers.size());
  for (const std::size_t number : numbers)
    out.number(number);
}

void put(os::ByteSink& out, const std::vector<std::string>& texts) {
  out.number(texts.size());
  for (const std::string& text : texts)
    out.text(text);
}

void put(os::ByteSink& out, const Hdf5Dataset& set) {
  put(out, set.attributes);
  put(out, set.shape);
  out.number(set.scales.size());
  for (const auto& scale : set.scales) {
    out.number(scale ? is_text : is_absent);
    if (scale) out.text(*scale);
  }
  put(out, set.layout.chunk);
  put(out, set.layout.filters);
  out.number(set.layout.stored_bytes);
  out.number(set.is_text);
  out.number(set.in_memory);
  out.number(set.values.size());
  out.doubles(set.values);
  put(out, set.texts);
  out.text(set.fault);
  out.text(set.hint);
  out.text(set.other_type);
}

void put(os::ByteSink& out, const std::vector<Hdf5Other>& others) {
  out.number(others.size());
  for (const Hdf5Other& other : others) {
    out.text(other.name);
    out.text(other.what);
  }
}

// Parses the output of `put`; refuses any size that a file of these bytes cannot contain.
class Taker {
public:
  Taker(os::ByteSource& in, std::uint64_t file_bytes)
      : in_(in), most_(file_bytes * best_ratio + 65536) {}

  bool take(Hdf5Contents& all) {
    std::uint64_t groups = 0, datasets = 0;
    std::string name;
    if (!text(all.fault) || !text(all.hint) || !count(groups)) return false;
    for (std::uint64_t i = 0; i < groups; ++i)
      if (!text(name) || !take(all.groups[name])) return false;
    if (!count(datasets)) return false;
    for (std::uint64_t i = 0; i < datasets; ++i)
      if (!text(name) || !take(all.datasets[name])) return false;
    for (const auto& [group, attributes] : all.groups)
      if (!take(all.others[group])) return false;
    return true;
  }

private:
  bool text(std::string& text) { return in_.text(text, most_); }
  bool count(std::uint64_t& count) { return in_.number(count) && count <= most_; }

  bool take(Hdf5Attributes& attributes) {
    std::uint64_t size = 0, kind = 0;
    if (!count(size)) return false;
    for (std::uint64_t i = 0; i < size; ++i) {
      std::string name, words;
      double number = 0;
      if (!text(name) || !in_.number(kind)) return false;
      if (!(kind == is_text ? text(words) : in_.doubles({&number, 1}))) return false;
      if (kind == is_text)
        attributes[name] = std::move(words);
      else
        attributes[name] = number;
    }
    return true;
  }

  bool take(std::vector<std::size_t>& numbers) {
    std::uint64_t size = 0, number = 0;
    if (!count(size) || size > H5S_MAX_RANK) return false;
    for (std::uint64_t i = 0; i < size; ++i) {
      if (!in_.number(number)) return false;
      numbers.push_back(number);
    }
    return true;
  }

  bool take(std::vector<std::string>& texts) {
    std::uint64_t size = 0;
    if (!count(size)) return false;
    for (std::uint64_t i = 0; i < size; ++i)
      if (!text(texts.emplace_back())) return false;
    return true;
  }

  bool take(std::vector<Hdf5Other>& others) {
    std::uint64_t size = 0;
    if (!count(size)) return false;
    for (std::uint64_t i = 0; i < size; ++i) {
      Hdf5Other& other = others.emplace_back();
      if (!text(other.name) || !text(other.what)) return false;
    }
    return true;
  }

  bool take(std::vector<std::optional<std::string>>& scales) {
    std::uint64_t size = 0, kind = 0;
    if (!count(size) || size > H5S_MAX_RANK) return false;
    for (std::uint64_t i = 0; i < size; ++i) {
      scales.emplace_back();
      if (!in_.number(kind)) return false;
      if (kind == is_text && !text(scales.back().emplace())) return false;
    }
    return true;
  }

  bool take(Hdf5Dataset& set) {
    std::uint64_t stored = 0, text_kind = 0, held = 0, values = 0;
    if (!take(set.attributes) || !take(set.shape) || !take(set.scales) || !take(set.layout.chunk) ||
        !take(set.layout.filters) || !in_.number(stored) || !in_.number(text_kind) ||
        !in_.number(held) || !in_.number(values) || values > held_bytes / sizeof(double))
      return false;
    set.layout.stored_bytes = stored;
    set.is_text = text_kind == 1;
    set.in_memory = held == 1;
    set.values.resize(values);
    if (!in_.doubles(set.values) || !take(set.texts) || !text(set.fault) || !text(set.hint) ||
        !text(set.other_type))
      return false;
    const std::size_t wanted = set.count();
    return !set.fault.empty() || !set.in_memory ||
           (set.is_text ? set.texts.size() : set.values.size()) == wanted;
  }

  os::ByteSource& in_;
  std::uint64_t most_;
};

} // namespace

std::size_t Hdf5Dataset::count() const {
  std::size_t count = 1;
  for (const std::size_t n : shape)
    count *= n;
  return count;
}

void scan_hdf5(const std::filesystem::path& file, os::ByteSink& out) {
  silence();
  guard_library();
  Hdf5Contents all;
  try {
    all = Scan(file).contents();
    // An attribute that cannot be read is otherwise one that has no value.
    if (has_failed_read()) throw Unreadable{"cannot be read: the disk fails", "copy it again"};
  } catch (const Unreadable& error) {
    all.fault = error.what;
    all.hint = error.hint;
  }
  out.text(all.fault);
  out.text(all.hint);
  out.number(all.groups.size());
  for (const auto& [name, attributes] : all.groups) {
    out.text(name);
    put(out, attributes);
  }
  out.number(all.datasets.size());
  for (const auto& [name, set] : all.datasets) {
    out.text(name);
    put(out, set);
  }
  for (const auto& [name, attributes] : all.groups)
    put(out, all.others[name]);
}

void scan_values(const std::filesystem::path& file, const std::string& dataset, std::size_t most,
                 os::ByteSink& out) {
  silence();
  guard_library();
  Unreadable fault;
  try {
    Scan(file).values(dataset, most, out);
  } catch (const Unreadable& error) {
    fault = error;
  }
  out.number(0); // ends the list of blocks
  out.text(fault.what);
  out.text(fault.hint);
}

void scan_slices(const std::filesystem::path& file, std::span<const Hdf5Slice> wanted,
                 os::ByteSink& out) {
  silence();
  guard_library();
  try {
    const Scan scan(file);
    for (const Hdf5Slice& slice : wanted)
      scan.slice(slice, out);
  } catch (const Unreadable& error) {
    out.number(is_absent);
    out.text(error.what);
    out.text(error.hint);
  }
}

bool take_contents(os::ByteSource& in, std::uint64_t file_bytes, Hdf5Contents& contents) {
  return Taker(in, file_bytes).take(contents);
}

bool take_values(os::ByteSource& in, std::size_t count, std::size_t most,
                 const std::function<void(std::size_t, std::span<const double>)>& take,
                 std::string& fault, std::string& hint) {
  std::vector<double> values;
  std::size_t first = 0;
  std::uint64_t size = 0;
  while (in.number(size)) {
    if (size == 0)
      return in.text(fault, longest_text) && in.text(hint, longest_text) &&
             (!fault.empty() || first == count);
    if (size > most || size > count - first) return false;
    values.resize(size);
    if (!in.doubles(values)) return false;
    take(first, values);
    first += size;
  }
  return false;
}

bool take_slices(os::ByteSource& in, std::uint64_t file_bytes, std::span<const Hdf5Slice> wanted,
                 std::vector<Hdf5Values>& slices, std::string& fault, std::string& hint) {
  const std::uint64_t longest = file_bytes * best_ratio + 65536;
  for (const Hdf5Slice& slice : wanted) {
    Hdf5Values& values = slices.emplace_back();
    for (std::size_t done = 0; done < slice.count; done += values_at_once) {
      const std::size_t count = std::min(values_at_once, slice.count - done);
      std::uint64_t kind = 0;
      if (!in.number(kind)) return false;
      if (kind == is_absent) return in.text(fault, longest_text) && in.text(hint, longest_text);
      if (kind == is_number) {
        values.numbers.resize(done + count);
        if (!in.doubles(std::span(values.numbers).subspan(done))) return false;
      }
      if (kind == is_text) values.texts.reserve(slice.count);
      for (std::size_t i = 0; kind == is_text && i < count; ++i)
        if (!in.text(values.texts.emplace_back(), longest)) return false;
    }
    if (values.numbers.size() + values.texts.size() != slice.count) return false;
  }
  return true;
}

} // namespace frictab::io
