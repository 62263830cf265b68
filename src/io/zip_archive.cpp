// Reads archives by libzip.
#include "io/zip_archive.h"

#include <fmt/format.h>
#include <zip.h>

#include "core/error.h"
#include "io/file_streams.h"

namespace frictab::io {

struct ZipArchive::Data {
  std::string named;
  ZipLimits limits;
  zip_t* archive = nullptr;

  [[noreturn]] void refuse(const std::string& what, const std::string& hint = "") const {
    throw InputError({named, 0, 0}, what, hint);
  }

  void check(const zip_stat_t& entry) const {
    const std::uint64_t packed = std::max<std::uint64_t>(entry.comp_size, 1);
    const bool is_trap =
        entry.size > limits.bytes_of_any_ratio && entry.size / packed > limits.ratio;
    if (entry.encryption_method != ZIP_EM_NONE)
      refuse(fmt::format("'{}' in it is encrypted", entry.name), "save it without a password");
    if (entry.size > limits.bytes || is_trap)
      refuse(fmt::format("'{}' in it would unfold to {} MiB from {} KiB", entry.name,
                         entry.size >> 20, entry.comp_size >> 10),
             fmt::format("read are at most {} MiB, and {} times the packed size: save the sheet as "
                         "CSV, or cut it into several",
                         limits.bytes >> 20, limits.ratio));
  }

  // Limits the time that reading takes: files in it may lie in the same place of the archive.
  void check_all() const {
    std::uint64_t bytes = 0;
    const zip_int64_t count = zip_get_num_entries(archive, 0);
    for (zip_int64_t i = 0; i < count; ++i) {
      zip_stat_t entry;
      zip_stat_init(&entry);
      const bool known = zip_stat_index(archive, static_cast<zip_uint64_t>(i), 0, &entry) == 0 &&
                         (entry.valid & ZIP_STAT_SIZE) != 0;
      bytes += known ? std::min(entry.size, limits.all_bytes) : 0;
      if (bytes > limits.all_bytes)
        refuse(fmt::format("its files would unfold to more than {} GiB", limits.all_bytes >> 30),
               "save its sheets as CSV");
    }
  }
};

ZipArchive::ZipArchive(const std::filesystem::path& path, const std::string& named,
                       ZipLimits limits)
    : data_(std::make_unique<Data>()) {
  data_->named = named;
  data_->limits = limits;
  const InputFile checked(path, named, limits.file_bytes); // a pipe would be waited for
  int code = 0;
  data_->archive = zip_open(path.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &code);
  if (data_->archive) {
    data_->check_all();
    return;
  }
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  data_->refuse("is a damaged archive: " + reason,
                "copy it again from where it came; a spreadsheet program may repair a workbook");
}

ZipArchive::~ZipArchive() {
  if (data_->archive) zip_discard(data_->archive);
}

std::optional<std::string> ZipArchive::read(const std::string& name) const {
  zip_stat_t entry;
  zip_stat_init(&entry);
  if (zip_stat(data_->archive, name.c_str(), ZIP_FL_ENC_GUESS, &entry) != 0) return std::nullopt;
  constexpr zip_uint64_t needed = ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_ENCRYPTION_METHOD;
  if ((entry.valid & needed) != needed) data_->refuse(fmt::format("'{}' in it has no size", name));
  data_->check(entry);
  std::string text(entry.size, '\0');
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(
      zip_fopen_index(data_->archive, entry.index, 0), zip_fclose);
  const zip_int64_t got = file ? zip_fread(file.get(), text.data(), text.size()) : -1;
  // one more byte: the checksum is compared at the end
  char beyond = 0;
  const bool ends = got >= 0 && zip_fread(file.get(), &beyond, 1) == 0;
  if (got < 0 || static_cast<std::size_t>(got) != text.size() || !ends)
    data_->refuse(fmt::format("'{}' in it is damaged", name),
                  "copy the file again from where it came");
  return text;
}

} // namespace frictab::io
