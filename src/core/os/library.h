// Shared libraries that are loaded while the program runs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace frictab::os {

// A loaded shared library; the destructor closes it.
class Library {
public:
  explicit Library(const std::filesystem::path& file); // throws std::runtime_error
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  void* handle() const { return handle_; }
  // These throw std::runtime_error if the library does not have the symbol.
  template <class Function> Function* find(const std::string& symbol) const {
    return reinterpret_cast<Function*>(address(handle_, symbol));
  }
  static void* address(void* handle, const std::string& symbol);
  // Returns null if the library does not have the symbol.
  static void* address_or_null(void* handle, const std::string& symbol);

private:
  void* handle_;
};

// A shared library of this process: the name that its users ask for, "libz.so.1", and the file to
// which that led, "/usr/lib/x86_64-linux-gnu/libz.so.1.2.13", whose name has the version.
struct LoadedLibrary {
  std::string name;
  std::filesystem::path file;
};

// Returns all that are loaded now, sorted by name.
std::vector<LoadedLibrary> loaded_libraries();

} // namespace frictab::os
