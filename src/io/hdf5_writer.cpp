// Writes HDF5 files through the C API.
#include <algorithm>
#include <functional>
#include <numeric>

#include <fmt/format.h>
#include <hdf5_hl.h>

#include "io/file_streams.h"
#include "io/hdf5.h"
#include "io/hdf5_handle.h"

namespace frictab::io {

using namespace hdf5;

namespace {

void must(bool ok, const std::string& what) {
  if (!ok) throw std::runtime_error("HDF5: cannot " + what);
}

std::vector<hsize_t> dimensions(std::span<const std::size_t> shape) {
  return {shape.begin(), shape.end()};
}

// Creation list without time stamps, so that the same content gives the same bytes.
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
  Data(hid_t id, std::filesystem::path name) : file(id, H5Fclose), path(std::move(name)) {}
  std::unique_lock<std::recursive_mutex> lock{library()};
  Handle file; // in memory
  std::filesystem::path path;
};

Hdf5Writer::Hdf5Writer(const std::filesystem::path& file) {
  constexpr std::size_t grows_by = std::size_t{1} << 20;
  const std::lock_guard lock(library());
  silence();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // In memory, so that close() knows every byte that the disk has to give back.
  H5Pset_fapl_core(access, grows_by, false);
  // Headers with checksums, which the library's earliest format lacks.
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false); // of the root group
  data_ = std::make_unique<Data>(H5Fcreate(file.string().c_str(), H5F_ACC_TRUNC, creation, access),
                                 file);
  must(data_->file.ok(), "make a file in memory");
}

Hdf5Writer::~Hdf5Writer() = default;

namespace {

constexpr std::size_t usual_chunk = 65536;

Handle space_of(const std::vector<hsize_t>& dims) {
  return {dims.empty() ? H5Screate(H5S_SCALAR)
                       : H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr),
          H5Sclose};
}

// `list`: the storage of the dataset in the file.
Handle create(hid_t file, const std::string& name, hid_t space, hid_t list) {
  const hid_t set =
      H5Dcreate2(file, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, list, H5P_DEFAULT);
  must(set >= 0, "create the dataset " + name);
  return {set, H5Dclose};
}

void set_storage(hid_t list, const std::vector<hsize_t>& dims, const Hdf5Storage& storage) {
  const bool empty = std::find(dims.begin(), dims.end(), hsize_t{0}) != dims.end();
  if (!storage.chunked() || dims.empty() || empty) return;
  const auto chunk = block_shape(dims, storage.chunk > 0 ? storage.chunk : usual_chunk);
  H5Pset_chunk(list, static_cast<int>(chunk.size()), chunk.data());
  if (storage.compress > 0) {
    H5Pset_shuffle(list);
    H5Pset_deflate(list, static_cast<unsigned>(storage.compress));
  }
  if (storage.fletcher32) H5Pset_fletcher32(list);
}

} // namespace

void Hdf5Writer::dataset(const std::string& name, std::span<const std::size_t> shape,
                         std::span<const double> values, const Hdf5Storage& storage) {
  must(values.size() ==
           std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>()),
       "write " + name + ": its values do not fill its shape");
  const auto dims = dimensions(shape);
  const Handle space = space_of(dims), list(without_times(), H5Pclose);
  set_storage(list, dims, storage);
  Handle set = create(data_->file, name, space, list);
  must(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
       "write the dataset " + name);
  set.close();
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
  set.close();
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name,
                           const std::string& text) {
  // H5LT cannot write an empty text.
  const char* const written = text.empty() ? " " : text.c_str();
  must(H5LTset_attribute_string(data_->file, object.c_str(), name.c_str(), written) >= 0,
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
  ruler.close();
  set.close();
}

void Hdf5Writer::close() {
  must(H5Fflush(data_->file, H5F_SCOPE_GLOBAL) >= 0, "finish " + data_->path.string());
  const ssize_t size = H5Fget_file_image(data_->file, nullptr, 0);
  void* memory = nullptr; // where the driver has the file's address
  must(size > 0 && H5Fget_vfd_handle(data_->file, H5P_DEFAULT, &memory) >= 0 && memory,
       "finish " + data_->path.string());
  write_file(data_->path, {*static_cast<const char**>(memory), static_cast<std::size_t>(size)});
  data_->file.close();
}

} // namespace frictab::io
