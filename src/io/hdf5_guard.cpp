// Asks for the links and the storage of all objects.
#include "io/hdf5_guard.h"

#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "io/hdf5_handle.h"

namespace frictab::io::hdf5 {

namespace {

bool read_failed = false; // of the child process that has set the guard

// The driver says `errno = 5` where the operating system refuses; damaged contents have no such
// words.
herr_t note_failed_read(hid_t stack, void*) {
  const auto look = [](unsigned, const H5E_error2_t* error, void*) -> herr_t {
    read_failed =
        read_failed || (error->maj_num == H5E_IO && error->min_num == H5E_READERROR &&
                        std::string_view(error->desc).find("errno = ") != std::string_view::npos);
    return 0;
  };
  return H5Ewalk2(stack, H5E_WALK_UPWARD, look, nullptr);
}

std::string target_of(hid_t group, const char* name, const H5L_info_t& link) {
  std::string value(link.u.val_size, '\0');
  const char *file = nullptr, *object = nullptr;
  unsigned flags = 0;
  if (H5Lget_val(group, name, value.data(), value.size(), H5P_DEFAULT) < 0 ||
      H5Lunpack_elink_val(value.data(), value.size(), &flags, &file, &object) < 0)
    return "";
  return std::string(", ") + file;
}

std::optional<std::string> storage_elsewhere(hid_t group, const char* name) {
  const Handle object(H5Oopen(group, name, H5P_DEFAULT), H5Oclose);
  if (!object.ok() || H5Iget_type(object) != H5I_DATASET) return std::nullopt;
  const Handle list(H5Dget_create_plist(object), H5Pclose);
  if (H5Pget_layout(list) == H5D_VIRTUAL)
    return fmt::format("'{}' is a virtual dataset: its values lie in other files, which are not "
                       "read",
                       name);
  if (H5Pget_external_count(list) <= 0) return std::nullopt;
  char file[256] = {};
  off_t offset = 0;
  hsize_t size = 0;
  H5Pget_external(list, 0, sizeof file - 1, file, &offset, &size);
  return fmt::format("the values of '{}' lie in another file, {}, which is not read", name, file);
}

} // namespace

void guard_library() {
  H5PLset_loading_state(0);
  H5Eset_auto2(H5E_DEFAULT, note_failed_read, nullptr);
}

bool has_failed_read() {
  return read_failed;
}

void check_in_itself(hid_t file) {
  std::optional<std::string> found;
  const auto visit = [](hid_t group, const char* name, const H5L_info_t* link,
                        void* into) -> herr_t {
    auto& what = *static_cast<std::optional<std::string>*>(into);
    if (link->type == H5L_TYPE_HARD)
      what = storage_elsewhere(group, name);
    else if (link->type != H5L_TYPE_SOFT) // a soft link ends in this file, or passes another link
      what = fmt::format("'{}' is a link into another file{}, which is not read", name,
                         target_of(group, name, *link));
    return what ? 1 : 0;
  };
  H5Lvisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, visit, &found);
  H5Lunregister(H5L_TYPE_EXTERNAL);
  if (found)
    throw Elsewhere{*found, "copy the values into this file, where the others are: h5py's "
                            "copy(..., expand_external=True), or read and write the dataset"};
}

} // namespace frictab::io::hdf5
