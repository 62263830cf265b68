// Loads libraries by dlopen.
#include "core/os/library.h"

#include <algorithm>
#include <stdexcept>

#include <dlfcn.h>
#include <link.h>

namespace frictab::os {

static int add_loaded(dl_phdr_info* info, std::size_t, void* all) {
  const std::filesystem::path found = info->dlpi_name; // empty: the program itself
  if (!found.has_parent_path()) return 0;              // a part of the kernel
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(found, error);
  static_cast<std::vector<LoadedLibrary>*>(all)->push_back(
      {found.filename().string(), error ? found : file});
  return 0;
}

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

std::vector<LoadedLibrary> loaded_libraries() {
  std::vector<LoadedLibrary> all;
  ::dl_iterate_phdr(add_loaded, &all);
  std::ranges::sort(all, {}, &LoadedLibrary::name);
  return all;
}

} // namespace frictab::os
