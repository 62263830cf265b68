// HDF5 through its C API: handles close themselves, errors become exceptions.
#include "io/hdf5.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <mutex>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <hdf5_hl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"

namespace frictab {

namespace {

using Close = herr_t (*)(hid_t);

class Handle {
public:
  Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  bool ok() const { return id_ >= 0; }
  void close() {
    if (id_ >= 0 && close_(std::exchange(id_, -1)) < 0)
      throw std::runtime_error("HDF5: closing failed (disk full?)");
  }

private:
  hid_t id_;
  Close close_;
};

// The library prints its error stack unless told otherwise; our messages are enough.
void silence() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

// The library is not made for threads: one file at a time.
std::recursive_mutex& library(bool renew = false) {
  static auto mutex = std::make_unique<std::recursive_mutex>();
  // A forked child is another owner: it cannot take what its parent holds, nor needs to.
  if (renew) static_cast<void>(mutex.release()), mutex = std::make_unique<std::recursive_mutex>();
  return *mutex;
}

void must(bool ok, const std::string& what) {
  if (!ok) throw std::runtime_error("HDF5: cannot " + what);
}

std::vector<hsize_t> dimensions(std::span<const std::size_t> shape) {
  return {shape.begin(), shape.end()};
}

// Creation without time stamps, so that the same content gives the same bytes.
hid_t without_times() {
  const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_obj_track_times(list, false);
  return list;
}

hid_t text_type(std::size_t size) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, size);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

} // namespace

struct Hdf5Writer::Data {
  explicit Data(hid_t id) : file(id, H5Fclose) {}
  std::unique_lock<std::recursive_mutex> lock{library()};
  Handle file;
};

Hdf5Writer::Hdf5Writer(const std::filesystem::path& file) {
  const std::lock_guard lock(library());
  silence();
  // Headers with checksums, which the library's earliest format has not.
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false); // of the root group
  data_ = std::make_unique<Data>(H5Fcreate(file.string().c_str(), H5F_ACC_TRUNC, creation, access));
  must(data_->file.ok(), "create " + file.string());
}

Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::dataset(const std::string& name, std::span<const std::size_t> shape,
                         std::span<const double> values, int compress) {
  const auto dims = dimensions(shape);
  Handle space(dims.empty() ? H5Screate(H5S_SCALAR)
                            : H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr),
               H5Sclose);
  Handle list(without_times(), H5Pclose);
  if (compress > 0 && !dims.empty() && !values.empty()) {
    std::vector<hsize_t> chunk(dims);
    hsize_t cells = 1; // chunks of at most 64k values, whole along the last axes
    for (std::size_t d = chunk.size(); d-- > 0;) {
      chunk[d] = std::clamp<hsize_t>(65536 / cells, 1, chunk[d]);
      cells *= chunk[d];
    }
    H5Pset_chunk(list, static_cast<int>(chunk.size()), chunk.data());
    H5Pset_shuffle(list);
    H5Pset_deflate(list, static_cast<unsigned>(compress));
    H5Pset_fletcher32(list);
  }
  Handle set(
      H5Dcreate2(data_->file, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, list, H5P_DEFAULT),
      H5Dclose);
  must(set.ok(), "create the dataset " + name);
  must(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
       "write the dataset " + name);
}

void Hdf5Writer::dataset(const std::string& name, std::span<const std::string> values) {
  std::size_t width = 1;
  for (const std::string& value : values)
    width = std::max(width, value.size());
  std::string packed(width * values.size(), '\0');
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i].copy(&packed[i * width], width);
  Handle type(text_type(width), H5Tclose);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  const hsize_t count = values.size();
  Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  Handle list(without_times(), H5Pclose);
  Handle set(H5Dcreate2(data_->file, name.c_str(), type, space, H5P_DEFAULT, list, H5P_DEFAULT),
             H5Dclose);
  must(set.ok(), "create the dataset " + name);
  must(values.empty() || H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, packed.data()) >= 0,
       "write the dataset " + name);
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name,
                           const std::string& text) {
  // H5LT writes no empty text.
  const std::string written = text.empty() ? " " : text;
  must(H5LTset_attribute_string(data_->file, object.c_str(), name.c_str(), written.c_str()) >= 0,
       "write the attribute " + name);
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, double value) {
  attribute(object, name, std::span<const double>(&value, 1));
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name,
                           std::span<const double> values) {
  must(H5LTset_attribute_double(data_->file, object.c_str(), name.c_str(), values.data(),
                                values.size()) >= 0,
       "write the attribute " + name);
}

void Hdf5Writer::dimension_scale(const std::string& dataset, std::size_t axis,
                                 const std::string& scale) {
  Handle set(H5Dopen2(data_->file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
  Handle ruler(H5Dopen2(data_->file, scale.c_str(), H5P_DEFAULT), H5Dclose);
  must(set.ok() && ruler.ok(), "find " + dataset + " and " + scale);
  if (H5DSis_scale(ruler) <= 0)
    must(H5DSset_scale(ruler, scale.c_str()) >= 0, "make a dimension scale of " + scale);
  must(H5DSattach_scale(set, ruler, static_cast<unsigned>(axis)) >= 0, "attach " + scale);
}

void Hdf5Writer::close() {
  data_->file.close();
}

struct Hdf5Reader::Data {
  Data(hid_t id, std::string name) : file(id, H5Fclose), named(std::move(name)) {}
  std::unique_lock<std::recursive_mutex> lock{library()};
  Handle file;
  std::string named;

  [[noreturn]] void fail(const std::string& what, const std::string& hint = "") const {
    throw InputError({named, 0, 0}, what, hint);
  }
  Handle open(const std::string& dataset) const {
    const hid_t id = H5Dopen2(file, dataset.c_str(), H5P_DEFAULT);
    if (id < 0) fail("there is no dataset '" + dataset + "'");
    return {id, H5Dclose};
  }
};

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file, std::string named)
    : Hdf5Reader(file, std::move(named), Unchecked{}) {
  if (survives_reading(file)) return;
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

// Reads everything once; what is wrong is for the real reading to say.
void Hdf5Reader::read_all(const std::filesystem::path& file) {
  try {
    const Hdf5Reader in(file, "", Unchecked{});
    in.attributes("/");
    for (const std::string& name : in.datasets()) {
      in.attributes(name);
      const auto shape = in.shape(name);
      for (std::size_t axis = 0; axis < shape.size(); ++axis)
        in.scale(name, axis);
      in.is_text(name) ? void(in.texts(name)) : void(in.values(name));
    }
  } catch (const std::exception&) {
  }
}

// The library can crash on damaged files, and its checksums are optional. A child process reads the
// file first; only what it survives is read here.
bool Hdf5Reader::survives_reading(const std::filesystem::path& file) {
  const std::lock_guard lock(library());
  const pid_t child = ::fork();
  if (child < 0) return true;
  if (child == 0) {
    library(true);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDERR_FILENO); // a sanitizer's or the C library's last words
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    ::alarm(60); // a loop of links in a damaged file
    read_all(file);
    ::_exit(0);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

Hdf5Reader::~Hdf5Reader() = default;

std::vector<std::string> Hdf5Reader::datasets() const {
  std::vector<std::string> names;
  const auto visit = [](hid_t group, const char* name, const H5L_info_t*, void* into) -> herr_t {
    Handle object(H5Oopen(group, name, H5P_DEFAULT), H5Oclose);
    if (object.ok() && H5Iget_type(object) == H5I_DATASET)
      static_cast<std::vector<std::string>*>(into)->push_back(name);
    return 0;
  };
  if (H5Literate(data_->file, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &names) < 0)
    data_->fail("its list of datasets cannot be read", "the file may be damaged");
  std::sort(names.begin(), names.end());
  return names;
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
    data_->fail("'" + dataset + "' cannot be read", "the file may be damaged");
  return values;
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

} // namespace frictab
