// Shared libraries that are loaded while the program runs.
#pragma once

#include <filesystem>
#include <string>

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

} // namespace frictab::os
