// HDF5 files by two small classes (C API inside). HDF5's own error printing is off; failures are
// exceptions with the file's name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/column_groups.h"

namespace frictab::io {

// Storage of a dataset in the file.
struct Hdf5Storage {
  // Values per chunk; 0: contiguous, or 65536 with a filter.
  std::size_t chunk = 0;
  // Deflate level 0..9, applied after a byte shuffle.
  std::size_t compress = 0;
  bool fletcher32 = false; // checksum per chunk, verified by every reader
  bool chunked() const { return chunk > 0 || compress > 0 || fletcher32; }
};

// Writes an HDF5 file, which is in memory until close(). Throws std::runtime_error if the disk or
// the library fails. No times are stored: the same content gives the same bytes.
class Hdf5Writer {
public:
  explicit Hdf5Writer(const std::filesystem::path& file);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  // Row-major doubles; an empty shape is a scalar.
  void dataset(const std::string& name, std::span<const std::size_t> shape,
               std::span<const double> values, const Hdf5Storage& storage = {});
  void dataset(const std::string& name, std::span<const std::string> values); // 1-D, UTF-8
  // object: a dataset's name, or "/" for the root.
  void attribute(const std::string& object, const std::string& name, const std::string& text);
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name,
                 std::span<const double> values);
  // Makes `scale` a dimension scale (netCDF-4 coordinate) and attaches it to one axis of `dataset`.
  void dimension_scale(const std::string& dataset, std::size_t axis, const std::string& scale);
  // Writes the file and compares, as OutputFile does.
  void close();

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// Storage of a dataset as found in a file.
struct Hdf5Layout {
  std::vector<std::size_t> chunk;   // shape of a chunk; empty: contiguous
  std::vector<std::string> filters; // "shuffle", "deflate 4", "fletcher32", ...
  std::uint64_t stored_bytes = 0;
};

// Part of a dataset with one long axis (length_of_column): `count` values from index `first` on.
struct Hdf5Slice {
  std::string dataset;
  std::size_t first = 0, count = 0;
};

struct Hdf5Values { // values of one slice
  std::vector<double> numbers;
  std::vector<std::string> texts; // used instead if the dataset is text
};

// Any content of a group other than datasets and attributes of one number or text.
using Hdf5Other = GroupOther;

// Length of the only axis longer than 1: n for n, n x 1 and 1 x n; nullopt for a scalar or with two
// such axes.
std::optional<std::size_t> length_of_column(std::span<const std::size_t> shape);

struct Hdf5Contents; // hdf5_scan.h

// Contents of an HDF5 file, read in a child process: the library can crash or hang on a damaged
// file, and this process never opens it. Datasets of up to 16 MiB are read together with the
// description (256 MiB in total), others on request. Throws InputError if the file is not an HDF5
// file, is damaged, or lacks what is requested.
class Hdf5Reader {
public:
  // `named`: the file's name in messages.
  Hdf5Reader(const std::filesystem::path& file, std::string named);
  // Takes the result of a child's scan; all its datasets are in memory.
  Hdf5Reader(const Hdf5Contents& contents, std::string named);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  // Datasets of a group (a path from the root), sorted by name; the functions below take them as
  // GROUP/NAME.
  std::vector<std::string> datasets(const std::string& group = "/") const;
  // Groups of the root group, sorted by name.
  std::vector<std::string> groups() const;
  // Other contents of a group ("/" = root): groups within a group, links to nothing, attributes of
  // many values.
  std::vector<Hdf5Other> others(const std::string& group) const;
  bool has(const std::string& dataset) const;
  bool is_text(const std::string& dataset) const;
  // Type of its values if they are neither numbers nor texts: "records of r, i"; else empty.
  std::string other_type(const std::string& dataset) const;
  // Reason why its values cannot be read, as far as known without reading them; else empty.
  std::string fault(const std::string& dataset) const;
  std::vector<std::size_t> shape(const std::string& dataset) const;
  std::vector<double> values(const std::string& dataset) const;     // any numeric type
  std::vector<std::string> texts(const std::string& dataset) const; // fixed or variable length
  // Calls `take` with all values in ascending order, at most `most` at a time.
  void blocks(const std::string& dataset, std::size_t most,
              const std::function<void(std::size_t first, std::span<const double>)>& take) const;
  // Returns the slices in the requested order; one child process reads them all.
  std::vector<Hdf5Values> slices(std::span<const Hdf5Slice> wanted) const;
  Hdf5Layout layout(const std::string& dataset) const;
  // Names of all attributes of an object ("/" = root) that contain one text or one number.
  std::vector<std::string> attributes(const std::string& object) const;
  std::optional<std::string> text_attribute(const std::string& object,
                                            const std::string& name) const;
  std::optional<double> number_attribute(const std::string& object, const std::string& name) const;
  // Name of the dimension scale of one axis; nullopt if there is none.
  std::optional<std::string> scale(const std::string& dataset, std::size_t axis) const;

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// True if the file has the HDF5 signature at its start, or after a user block of 512, 1024, 2048
// ... bytes.
bool looks_like_hdf5(const std::filesystem::path& file);

} // namespace frictab::io
