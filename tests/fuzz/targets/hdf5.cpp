// Table files. A child process reads HDF5 and hands over plain data; what this process makes of
// them is fuzzed in three steps: a file's bytes, the child's bytes, and the plain data written as
// lines.
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <sys/mman.h>
#include <unistd.h>

#include "fuzz/target.h"
#include "fuzz/temporary_file.h"
#include "io/hdf5_scan.h"
#include "table/info.h"
#include "table/interpolation.h"
#include "table/table_file.h"

namespace frictab::fuzz::hdf5_target {
namespace {

constexpr std::size_t most_values = 4096; // larger tables show nothing more

void check(const table::Table& table) {
  promise(table.value.size() == table.nodes(), "a table has a value per node");
  for (const double value : table.value)
    promise(std::isfinite(value), "a table's values are finite");
  for (const table::TableAxis& axis : table.axes)
    for (std::size_t i = 0; i < axis.nodes.size(); ++i)
      promise(std::isfinite(axis.nodes[i]) && (i == 0 || axis.nodes[i - 1] < axis.nodes[i]),
              "an axis ascends");
  const table::TableFunction function(table);
  std::vector<double> state;
  for (const std::string& name : function.inputs())
    state.push_back(table.range(name).value_or(std::pair{1.0, 2.0}).second);
  function(state);
  table::TableDescription description;
  description.table = table;
  table::info_text(description, "t.h5");
  table::info_json(description, "t.h5");
}

// "shape 3 4", "scale psi", "values 1 2.5 4" (again from the first where there are more nodes),
// "text NAME WORDS", "number NAME 0.5" of the dataset of the last "dataset NAME", or of the root.
class Lines {
public:
  io::Hdf5Contents contents;

  void read(std::string_view text) {
    std::istringstream lines{std::string(text)};
    for (std::string line; std::getline(lines, line);)
      read_line(line);
    for (auto& [name, set] : contents.datasets)
      fill(set);
  }

private:
  void read_line(const std::string& line) {
    std::istringstream words(line);
    std::string kind, name;
    words >> kind;
    if (kind == "values") return read_values(words);
    words >> name;
    io::Hdf5Dataset& set = contents.datasets[dataset_];
    io::Hdf5Attributes& attributes = dataset_.empty() ? contents.groups["/"] : set.attributes;
    if (kind == "dataset") dataset_ = name;
    if (kind == "scale") set.scales.emplace_back(name);
    if (kind == "shape")
      for (; !name.empty(); name.clear(), words >> name)
        set.shape.push_back(std::strtoull(name.c_str(), nullptr, 10) % (most_values + 1));
    std::string rest;
    std::getline(words >> std::ws, rest);
    if (kind == "text") attributes[name] = rest;
    if (kind == "number") attributes[name] = std::strtod(rest.c_str(), nullptr);
  }

  void read_values(std::istringstream& words) {
    for (std::string word; words >> word;)
      contents.datasets[dataset_].values.push_back(std::strtod(word.c_str(), nullptr));
  }

  static void fill(io::Hdf5Dataset& set) {
    set.in_memory = true;
    std::size_t count = 1;
    for (std::size_t& n : set.shape)
      count *= n = std::min(n, count == 0 ? n : most_values / count);
    const std::size_t given = set.values.size();
    set.values.resize(count);
    for (std::size_t i = given; i < count; ++i)
      set.values[i] = given > 0 ? set.values[i % given] : 0;
  }

  std::string dataset_;
};

void read_lines(std::string_view text) {
  Lines lines;
  lines.read(text);
  lines.contents.datasets.erase("");
  check(table::read_table(lines.contents, "t.h5"));
}

void read_file(std::string_view bytes) {
  static const TemporaryFile file("t.h5");
  file.write(bytes);
  check(table::read_table(file.path()));
}

// What a child, broken by the file it reads, may hand over.
void read_scan(std::string_view bytes) {
  const int file = ::memfd_create("scan", MFD_CLOEXEC);
  promise(file >= 0 && ::write(file, bytes.data(), bytes.size()) == ssize_t(bytes.size()) &&
              ::lseek(file, 0, SEEK_SET) == 0,
          "there is memory for the scan");
  os::ByteSource source(file);
  io::Hdf5Contents contents;
  const bool taken = io::take_contents(source, bytes.size(), contents);
  ::close(file);
  if (!taken) throw InputError({"t.h5", 0, 0}, "is damaged");
  for (const auto& [name, set] : contents.datasets) {
    promise(!set.in_memory || !set.fault.empty() ||
                (set.is_text ? set.texts.size() : set.values.size()) == set.count(),
            "a dataset that is held has all its values");
    if (!set.in_memory) return; // its values stay in the file
  }
  check(table::read_table(contents, "t.h5"));
}

const Registered<Target> lines([] { return Target{"table", read_lines}; });
const Registered<Target> scan([] { return Target{"scan", read_scan}; });
const Registered<Target> file([] { return Target{"hdf5", read_file}; });

} // namespace
} // namespace frictab::fuzz::hdf5_target
