// HDF5 files behind two small classes (C API inside). HDF5's own error printing is off; what fails
// is said by exceptions with the file's name.
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

namespace frictab::io {

// How the values of a dataset lie in the file.
struct Hdf5Storage {
  std::size_t chunk = 0;    // values per chunk; 0: in one piece, or 65536 where a filter is on
  std::size_t compress = 0; // deflate level 0..9, behind a shuffle of bytes
  bool fletcher32 = false;  // a checksum per chunk, checked by every reader
  bool chunked() const { return chunk > 0 || compress > 0 || fletcher32; }
};

// Throws std::runtime_error where the disk or the library refuses. No times are stored: the same
// content gives the same bytes.
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
  // Makes `scale` a dimension scale (netCDF-4 coordinate) and ties it to one axis of `dataset`.
  void dimension_scale(const std::string& dataset, std::size_t axis, const std::string& scale);
  // Flushes, reads the file again and compares; throws where that fails, also InputError where the
  // file cannot be read.
  void close();

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// How a dataset was found to lie in a file.
struct Hdf5Layout {
  std::vector<std::size_t> chunk;   // shape of a chunk; empty: in one piece
  std::vector<std::string> filters; // "shuffle", "deflate 4", "fletcher32", ...
  std::uint64_t stored_bytes = 0;
};

// Of a dataset with one long axis (length_of_column): `count` values from the `first` one on.
struct Hdf5Slice {
  std::string dataset;
  std::size_t first = 0, count = 0;
};

struct Hdf5Values { // of one slice
  std::vector<double> numbers;
  std::vector<std::string> texts; // instead, where the dataset is text
};

// What stands in a group and is neither a dataset nor an attribute of one number or text.
struct Hdf5Other {
  std::string name;
  std::string what; // "an attribute of 2 values"
};

// How many values the one long axis has: n for n, n x 1 and 1 x n; nullopt for a scalar and where
// two axes are longer.
std::optional<std::size_t> length_of_column(std::span<const std::size_t> shape);

struct Hdf5Contents; // hdf5_scan.h

// What an HDF5 file holds, as a child process reads it: the library can crash or hang on a damaged
// file, and this process never opens it. Datasets of up to 16 MiB are read with the description
// (256 MiB together), others where they are asked for. Throws InputError where the file is no HDF5
// file, is damaged, or lacks what is asked for.
class Hdf5Reader {
public:
  // `named` is how messages call the file.
  Hdf5Reader(const std::filesystem::path& file, std::string named);
  // What a child has found; all its datasets are held.
  Hdf5Reader(const Hdf5Contents& contents, std::string named);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  // Of a group (a path from the root), sorted by name; as GROUP/NAME the functions below know them.
  std::vector<std::string> datasets(const std::string& group = "/") const;
  std::vector<std::string> groups() const; // of the root group, sorted by name
  // Of a group ("/" = root): groups within a group, links to nothing, attributes of many values.
  std::vector<Hdf5Other> others(const std::string& group) const;
  bool has(const std::string& dataset) const;
  bool is_text(const std::string& dataset) const;
  // What its values are where they are neither numbers nor texts: "records of r, i"; else empty.
  std::string other_type(const std::string& dataset) const;
  // Why its values cannot be read, as far as that is known without asking for them; else empty.
  std::string fault(const std::string& dataset) const;
  std::vector<std::size_t> shape(const std::string& dataset) const;
  std::vector<double> values(const std::string& dataset) const;     // any numeric type
  std::vector<std::string> texts(const std::string& dataset) const; // fixed or variable length
  // All values in ascending order, at most `most` at a time.
  void blocks(const std::string& dataset, std::size_t most,
              const std::function<void(std::size_t first, std::span<const double>)>& take) const;
  // In the order asked for; one child process for all of them.
  std::vector<Hdf5Values> slices(std::span<const Hdf5Slice> wanted) const;
  Hdf5Layout layout(const std::string& dataset) const;
  // Names of all attributes of an object ("/" = root) that hold one text or one number.
  std::vector<std::string> attributes(const std::string& object) const;
  std::optional<std::string> text_attribute(const std::string& object,
                                            const std::string& name) const;
  std::optional<double> number_attribute(const std::string& object, const std::string& name) const;
  // Name of the dimension scale of one axis; nullopt where there is none.
  std::optional<std::string> scale(const std::string& dataset, std::size_t axis) const;

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// True where the file starts like HDF5.
bool looks_like_hdf5(const std::filesystem::path& file);

} // namespace frictab::io
