// Chooses the reader by the signature of the file.
#include "data/rig_files.h"

#include <cstdint>
#include <limits>

#include "data/group_columns.h"
#include "data/raw.h"
#include "io/lvm.h"
#include "io/mat.h"
#include "io/tdms.h"
#include "io/text_file.h"

namespace frictab::data {

bool is_rig_file(const std::string& path) {
  return io::looks_like_lvm(path) || io::looks_like_tdms(path) || io::looks_like_mat(path);
}

std::optional<io::CsvTable> read_rig_file(const std::string& path, const std::string& named,
                                          const DataOptions& options, FaultList& faults) {
  if (io::looks_like_lvm(path)) {
    io::CsvTable table =
        io::parse_lvm(io::read_text_file(path, named), named, csv_format(path, options), faults);
    table.form = "LabVIEW text";
    return table;
  }
  const bool is_tdms = io::looks_like_tdms(path);
  if (!is_tdms && !io::looks_like_mat(path)) return std::nullopt;
  GroupColumns columns(is_tdms ? io::read_tdms(path, named) : io::read_mat(path, named), named,
                       options, faults);
  io::CsvTable table = columns.next(std::numeric_limits<std::uint64_t>::max());
  table.form = is_tdms ? "TDMS" : "MATLAB";
  return table;
}

} // namespace frictab::data
