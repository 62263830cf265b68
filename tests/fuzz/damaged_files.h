// How many damaged HDF5 files a test tries.
#pragma once

#include <cstddef>

namespace frictab::fuzz {

// `all`, and a quarter of them with AddressSanitizer: a process of its own reads each of these
// files (io/isolated.h), and to fork is what takes the time there. `.ci/fuzz 600 hdf5` tries many
// more.
constexpr std::size_t damaged_files(std::size_t all) {
#ifdef __SANITIZE_ADDRESS__
  return all / 4;
#else
  return all;
#endif
}

} // namespace frictab::fuzz
