// Steps of a child process before it reads an HDF5 file of unknown origin.
#pragma once

#include <string>

#include <hdf5.h>

namespace frictab::io::hdf5 {

// A file whose values lie elsewhere.
struct Elsewhere {
  std::string what, hint;
};

// From here on the library of this process loads no plugin for a filter, and has_failed_read()
// returns whether the disk failed.
void guard_library();
bool has_failed_read();

// Visits all objects of an open file without reading values. Throws Elsewhere at the first whose
// values lie in other files: an external link, external storage, a virtual dataset. From here on
// the library follows no link into another file.
void check_in_itself(hid_t file);

} // namespace frictab::io::hdf5
