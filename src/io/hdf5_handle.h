// Shared by the HDF5 reader and writer: handles that close themselves, and the library's lock.
#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include <hdf5.h>

namespace frictab::io::hdf5 {

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

// Call before any other use of the library. Switches off its error printing, because our messages
// suffice, and its own cleanup at exit: handles close everything, and the cleanup would close a
// file on a failed disk a second time, which crashes.
inline void silence() {
  static const herr_t no_end_of_its_own = H5dont_atexit();
  static_cast<void>(no_end_of_its_own);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

// Lock of the library, which is not thread-safe: one file at a time.
inline std::recursive_mutex& library(bool renew = false) {
  static auto mutex = std::make_unique<std::recursive_mutex>();
  // A forked child needs a new lock: it cannot take a lock that its parent owns.
  if (renew) static_cast<void>(mutex.release()), mutex = std::make_unique<std::recursive_mutex>();
  return *mutex;
}

// A block of at most `most` consecutive values: the last axes whole, one in part, 1 along the
// others.
inline std::vector<hsize_t> block_shape(std::vector<hsize_t> dims, hsize_t most) {
  hsize_t values = 1;
  for (std::size_t d = dims.size(); d-- > 0;) {
    dims[d] = std::clamp<hsize_t>(most / values, 1, dims[d]);
    values *= dims[d];
  }
  return dims;
}

// Calls body(start, count, values) for the blocks of this shape that fill an array, row-major.
template <class Body>
void for_blocks(const std::vector<hsize_t>& dims, const std::vector<hsize_t>& block,
                const Body& body) {
  std::vector<hsize_t> start(dims.size(), 0), count(dims.size());
  while (true) {
    std::size_t values = 1;
    for (std::size_t d = 0; d < dims.size(); ++d) {
      count[d] = std::min(block[d], dims[d] - start[d]);
      values *= count[d];
    }
    body(start, count, values);
    std::size_t d = dims.size();
    while (d > 0 && (start[d - 1] += block[d - 1]) >= dims[d - 1])
      start[--d] = 0;
    if (d == 0) return;
  }
}

} // namespace frictab::io::hdf5
