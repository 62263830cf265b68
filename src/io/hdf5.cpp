// Reads HDF5 files through the C API: what fails becomes an InputError with the file's name.
#include "io/hdf5.h"

#include <algorithm>
#include <cerrno>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <hdf5_hl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"
#include "io/hdf5_handle.h"

namespace frictab::io {

using namespace hdf5;

struct Hdf5Reader::Data {
  Data(hid_t id, std::string name) : file(id, H5Fclose), named(std::move(name)) {}
  std::unique_lock<std::recursive_mutex> lock{library()};
  Handle file;
  std::string named;

  [[noreturn]] void fail(const std::string& what, const std::string& hint = "") const {
    throw InputError({named, 0, 0}, what, hint);
  }
  [[noreturn]] void fail_to_read(const std::string& dataset, hid_t set) const {
    const Handle list(H5Dget_create_plist(set), H5Pclose);
    if (H5Pget_nfilters(list) > 0)
      fail("'" + dataset + "' cannot be read: a chunk does not fit its checksum or its compression",
           "the file is damaged: write it again, or take a copy");
    fail("'" + dataset + "' cannot be read", "the file may be damaged");
  }
  Handle open(const std::string& dataset) const {
    const hid_t id = H5Dopen2(file, dataset.c_str(), H5P_DEFAULT);
    if (id < 0) fail("there is no dataset '" + dataset + "'");
    return {id, H5Dclose};
  }
};

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file, std::string named, bool large)
    : Hdf5Reader(file, std::move(named), Unchecked{}) {
  if (survives_reading(file, large)) return;
  data_->fail("is damaged: the HDF5 library crashes on it", "write it again from its source");
}

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file, std::string named, Unchecked) {
  const std::lock_guard lock(library());
  silence();
  data_ = std::make_unique<Data>(H5Fopen(file.string().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
                                 std::move(named));
  if (!data_->file.ok())
    data_->fail("cannot be opened as HDF5",
                "it may be cut short or of another format; write it again, or give a CSV file");
}

namespace {
constexpr std::size_t small_bytes = std::size_t{1} << 24; // read at a time
}

// `group` is a path with / behind it; empty for the root.
void Hdf5Reader::read_group(const Hdf5Reader& in, const std::string& group, bool large) {
  const std::string object = group.empty() ? "/" : group;
  in.attributes(object);
  for (const std::string& own : in.datasets(object)) {
    const std::string name = group + own;
    in.attributes(name);
    const auto shape = in.shape(name);
    for (std::size_t axis = 0; axis < shape.size(); ++axis)
      in.scale(name, axis);
    if (in.is_text(name))
      in.texts(name);
    else if (in.layout(name).stored_bytes < small_bytes || (large && !in.raw_offset(name)))
      in.blocks(name, small_bytes / sizeof(double), [](std::size_t, std::span<const double>) {});
  }
}

// Reads everything once, plain numbers of large datasets left out; what is wrong is for the real
// reading to say.
void Hdf5Reader::read_all(const std::filesystem::path& file, bool large) {
  try {
    const Hdf5Reader in(file, "", Unchecked{});
    read_group(in, "", large);
    for (const std::string& group : in.groups())
      read_group(in, group + "/", large);
  } catch (const std::exception&) {
  }
}

// The library can crash on damaged files, and its checksums are optional. A child process reads the
// file first; only what it survives is read here.
bool Hdf5Reader::survives_reading(const std::filesystem::path& file, bool large) {
  const std::lock_guard lock(library());
  const pid_t child = ::fork();
  if (child < 0) return true;
  if (child == 0) {
    library(true);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDERR_FILENO); // a sanitizer's or the C library's last words
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    // A loop of links in a damaged file would not end.
    std::error_code ignored;
    ::alarm(10 + static_cast<unsigned>(std::filesystem::file_size(file, ignored) >> 22));
    read_all(file, large);
    ::_exit(0);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

Hdf5Reader::~Hdf5Reader() = default;

std::vector<std::string> Hdf5Reader::members(const std::string& group, int type) const {
  struct Found {
    int type;
    std::vector<std::string> names;
  } found{type, {}};
  const auto visit = [](hid_t in, const char* name, const H5L_info_t*, void* into) -> herr_t {
    Found& all = *static_cast<Found*>(into);
    Handle object(H5Oopen(in, name, H5P_DEFAULT), H5Oclose);
    if (object.ok() && H5Iget_type(object) == all.type) all.names.push_back(name);
    return 0;
  };
  Handle in(H5Gopen2(data_->file, group.c_str(), H5P_DEFAULT), H5Gclose);
  if (!in.ok() || H5Literate(in, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &found) < 0)
    data_->fail("its list of datasets cannot be read", "the file may be damaged");
  std::sort(found.names.begin(), found.names.end());
  return found.names;
}

std::vector<std::string> Hdf5Reader::datasets(const std::string& group) const {
  return members(group, H5I_DATASET);
}

std::vector<std::string> Hdf5Reader::groups() const {
  return members("/", H5I_GROUP);
}

bool Hdf5Reader::has(const std::string& dataset) const {
  const auto names = datasets();
  return std::binary_search(names.begin(), names.end(), dataset);
}

bool Hdf5Reader::is_text(const std::string& dataset) const {
  const Handle set = data_->open(dataset);
  Handle type(H5Dget_type(set), H5Tclose);
  return H5Tget_class(type) == H5T_STRING;
}

std::vector<std::size_t> Hdf5Reader::shape(const std::string& dataset) const {
  const Handle set = data_->open(dataset);
  Handle space(H5Dget_space(set), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0) data_->fail("the shape of '" + dataset + "' cannot be read");
  std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
  if (rank > 0) H5Sget_simple_extent_dims(space, dims.data(), nullptr);
  return {dims.begin(), dims.end()};
}

namespace {

// A damaged header may claim any size: what a file cannot hold is refused before allocation.
std::size_t checked_count(const std::vector<std::size_t>& shape, hid_t file) {
  std::size_t count = 1;
  hsize_t bytes = 0;
  H5Fget_filesize(file, &bytes);
  const std::size_t limit = static_cast<std::size_t>(bytes) * 1100 + 1024; // deflate's best ratio
  for (const std::size_t n : shape) {
    if (n != 0 && count > limit / n) return SIZE_MAX;
    count *= n;
  }
  return count;
}

} // namespace

std::vector<double> Hdf5Reader::values(const std::string& dataset) const {
  const std::size_t count = checked_count(shape(dataset), data_->file);
  if (count == SIZE_MAX) data_->fail("'" + dataset + "' claims more values than the file can hold");
  const Handle set = data_->open(dataset);
  Handle type(H5Dget_type(set), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type);
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) data_->fail("'" + dataset + "' is not numeric");
  std::vector<double> values(count);
  if (count > 0 &&
      H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    data_->fail_to_read(dataset, set);
  return values;
}

void Hdf5Reader::blocks(
    const std::string& dataset, std::size_t most,
    const std::function<void(std::size_t first, std::span<const double>)>& take) const {
  const auto sizes = shape(dataset);
  const std::size_t count = checked_count(sizes, data_->file);
  if (count == SIZE_MAX) data_->fail("'" + dataset + "' claims more values than the file can hold");
  if (count == 0) return;
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_chunk_cache(access, 12421, std::size_t{1} << 26, 1); // chunks that span several blocks
  const Handle set(H5Dopen2(data_->file, dataset.c_str(), access), H5Dclose);
  const Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
  const H5T_class_t kind = H5Tget_class(type);
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) data_->fail("'" + dataset + "' is not numeric");
  const std::vector<hsize_t> dims(sizes.begin(), sizes.end());
  std::vector<double> values;
  std::size_t first = 0;
  for_blocks(dims, block_shape(dims, most), [&](const auto& start, const auto& part, hsize_t n) {
    values.resize(n);
    const Handle memory(H5Screate_simple(1, &n, nullptr), H5Sclose);
    if (!dims.empty())
      H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, part.data(), nullptr);
    if (H5Dread(set, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()) < 0)
      data_->fail_to_read(dataset, set);
    take(first, values);
    first += n;
  });
}

Hdf5Layout Hdf5Reader::layout(const std::string& dataset) const {
  const Handle set = data_->open(dataset);
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

std::optional<std::uint64_t> Hdf5Reader::raw_offset(const std::string& dataset) const {
  const Handle set = data_->open(dataset);
  const Handle list(H5Dget_create_plist(set), H5Pclose), type(H5Dget_type(set), H5Tclose);
  const Handle space(H5Dget_space(set), H5Sclose);
  const bool plain = H5Pget_layout(list) == H5D_CONTIGUOUS && H5Pget_external_count(list) == 0 &&
                     H5Tequal(type, H5T_IEEE_F64LE) > 0 &&
                     H5Tequal(type, H5T_NATIVE_DOUBLE) > 0; // of this machine too
  const haddr_t offset = plain ? H5Dget_offset(set) : HADDR_UNDEF;
  hsize_t bytes = 0;
  H5Fget_filesize(data_->file, &bytes);
  const auto values = static_cast<hsize_t>(std::max<hssize_t>(H5Sget_select_npoints(space), 0));
  if (offset == HADDR_UNDEF || offset > bytes || values > (bytes - offset) / sizeof(double))
    return std::nullopt;
  return offset;
}

std::vector<std::string> Hdf5Reader::texts(const std::string& dataset) const {
  const std::size_t count = checked_count(shape(dataset), data_->file);
  if (count == SIZE_MAX) data_->fail("'" + dataset + "' claims more values than the file can hold");
  const Handle set = data_->open(dataset);
  Handle type(H5Dget_type(set), H5Tclose);
  std::vector<std::string> values;
  const auto bad = [&] { data_->fail("'" + dataset + "' cannot be read as text"); };
  if (H5Tget_class(type) != H5T_STRING) bad();
  if (H5Tis_variable_str(type) > 0) {
    Handle memory(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(memory, H5T_VARIABLE);
    H5Tset_cset(memory, H5Tget_cset(type));
    std::vector<char*> raw(count, nullptr);
    if (count > 0 && H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data()) < 0) bad();
    for (char* text : raw) {
      values.emplace_back(text ? text : "");
      H5free_memory(text);
    }
    return values;
  }
  const std::size_t width = H5Tget_size(type);
  if (width == 0 || width > (std::size_t{1} << 20)) bad();
  std::string packed(width * count, '\0');
  if (count > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, packed.data()) < 0) bad();
  for (std::size_t i = 0; i < count; ++i) {
    std::string text = packed.substr(i * width, width);
    text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
    values.push_back(text);
  }
  return values;
}

std::vector<std::string> Hdf5Reader::attributes(const std::string& object) const {
  std::vector<std::string> names;
  Handle target(H5Oopen(data_->file, object.c_str(), H5P_DEFAULT), H5Oclose);
  if (!target.ok()) return names;
  const auto visit = [](hid_t, const char* name, const H5A_info_t*, void* into) -> herr_t {
    static_cast<std::vector<std::string>*>(into)->push_back(name);
    return 0;
  };
  H5Aiterate2(target, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &names);
  std::erase_if(names, [&](const std::string& name) {
    return !text_attribute(object, name) && !number_attribute(object, name);
  });
  return names;
}

std::optional<std::string> Hdf5Reader::text_attribute(const std::string& object,
                                                      const std::string& name) const {
  Handle attribute(
      H5Aopen_by_name(data_->file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  if (!attribute.ok()) return std::nullopt;
  Handle type(H5Aget_type(attribute), H5Tclose);
  Handle space(H5Aget_space(attribute), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1)
    return std::nullopt;
  if (H5Tis_variable_str(type) > 0) {
    char* raw = nullptr;
    if (H5Aread(attribute, type, &raw) < 0 || raw == nullptr) return std::nullopt;
    std::string text = raw;
    H5free_memory(raw);
    return text;
  }
  std::string text(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, text.data()) < 0) return std::nullopt;
  text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
  return text;
}

std::optional<double> Hdf5Reader::number_attribute(const std::string& object,
                                                   const std::string& name) const {
  Handle attribute(
      H5Aopen_by_name(data_->file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  if (!attribute.ok()) return std::nullopt;
  Handle type(H5Aget_type(attribute), H5Tclose);
  Handle space(H5Aget_space(attribute), H5Sclose);
  const H5T_class_t kind = H5Tget_class(type);
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || H5Sget_simple_extent_npoints(space) != 1)
    return std::nullopt;
  double value = 0;
  if (H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0) return std::nullopt;
  return value;
}

std::optional<std::string> Hdf5Reader::scale(const std::string& dataset, std::size_t axis) const {
  const Handle set = data_->open(dataset);
  std::optional<std::string> found;
  const auto visit = [](hid_t, unsigned, hid_t scale, void* into) -> herr_t {
    char name[256] = {};
    if (H5Iget_name(scale, name, sizeof name) > 0)
      *static_cast<std::optional<std::string>*>(into) = std::string(name + (name[0] == '/'));
    return 1; // the first is enough
  };
  H5DSiterate_scales(set, static_cast<unsigned>(axis), nullptr, visit, &found);
  return found;
}

bool looks_like_hdf5(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  char magic[8] = {};
  in.read(magic, sizeof magic);
  return in.gcount() == 8 && std::string_view(magic, 8) == std::string_view("\x89HDF\r\n\x1a\n", 8);
}

} // namespace frictab::io
