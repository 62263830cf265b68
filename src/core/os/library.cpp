// Loads libraries by dlopen.
#include "core/os/library.h"

#include <stdexcept>

#include <dlfcn.h>

namespace frictab::os {

Library::Library(const std::filesystem::path& file)
    : handle_(::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (!handle_) throw std::runtime_error(::dlerror());
}

Library::~Library() {
  ::dlclose(handle_);
}

void* Library::address(void* handle, const std::string& symbol) {
  if (void* const found = address_or_null(handle, symbol)) return found;
  throw std::runtime_error("no symbol '" + symbol + "' in the compiled library");
}

void* Library::address_or_null(void* handle, const std::string& symbol) {
  return ::dlsym(handle, symbol.c_str());
}

} // namespace frictab::os
