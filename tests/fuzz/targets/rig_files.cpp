// Files of measuring programs: LabVIEW text, TDMS, MATLAB, and the bytes that the child hands over.
#include <cmath>

#include <sys/mman.h>
#include <unistd.h>

#include "fuzz/target.h"
#include "fuzz/temporary_file.h"
#include "io/lvm.h"
#include "io/mat.h"
#include "io/tdms.h"

namespace frictab::fuzz::rig_files_target {
namespace {

void check(const io::ColumnGroup& group) {
  for (const io::GroupMember& member : group.members) {
    if (!member.other_type.empty() || member.shape.empty()) continue;
    const std::size_t values = member.is_text ? member.texts.size() : member.numbers.size();
    promise(member.shape == std::vector<std::size_t>{values, 1}, "a column has all its values");
    promise(member.single.has_value() == (values == 1), "one value is a single value");
  }
}

void check(const io::ColumnGroups& all) {
  check(all.root);
  for (const io::ColumnGroup& group : all.groups)
    check(group);
}

void read_lvm(std::string_view bytes) {
  FaultList faults;
  const io::CsvTable table = io::parse_lvm(std::string(bytes), "a.lvm", {}, faults);
  faults.throw_if_any();
  promise(table.rows() > 0 && table.interval.size() == table.rows(), "each row has its interval");
  for (const io::CsvColumn& column : table.columns)
    promise(column.numbers.size() == table.rows(), "each column has all rows");
}

void read_tdms(std::string_view bytes) {
  static const TemporaryFile file("a.tdms");
  file.write(bytes);
  check(io::read_tdms(file.path(), "a.tdms"));
}

void read_mat(std::string_view bytes) {
  static const TemporaryFile file("a.mat");
  file.write(bytes);
  check(io::read_mat(file.path(), "a.mat"));
}

// Output of a child that a broken file has led astray.
void read_groups(std::string_view bytes) {
  const int file = ::memfd_create("groups", MFD_CLOEXEC);
  promise(file >= 0 && ::write(file, bytes.data(), bytes.size()) == ssize_t(bytes.size()) &&
              ::lseek(file, 0, SEEK_SET) == 0,
          "there is memory for the groups");
  os::ByteSource source(file);
  io::ColumnGroups all;
  std::string fault;
  const bool taken = io::take_groups(source, bytes.size(), all, fault);
  ::close(file);
  if (!taken || !fault.empty()) throw InputError({"a.mat", 0, 0}, "is damaged");
  check(all);
}

const Registered<Target> lvm([] { return Target{"lvm", read_lvm}; });
const Registered<Target> tdms([] { return Target{"tdms", read_tdms}; });
const Registered<Target> mat([] { return Target{"mat", read_mat}; });
const Registered<Target> groups([] { return Target{"groups", read_groups}; });

} // namespace
} // namespace frictab::fuzz::rig_files_target
