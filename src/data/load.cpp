// From files to a campaign: map, gather experiments, join, compute, leave out, check, append.
#include "data/load.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <tuple>

#include <fmt/format.h>

#include "core/large_work.h"
#include "core/parallel.h"
#include "core/text.h"
#include "data/append.h"
#include "data/checks.h"
#include "data/computed.h"
#include "data/file_list.h"
#include "data/join.h"
#include "data/leave_out.h"
#include "data/test_table.h"
#include "data/wide.h"

namespace frictab::data {

namespace {

// What is brought to every file from elsewhere.
struct Beside {
  std::optional<TestTable> tests;
  std::optional<Dataset> second; // of data.join
};

// What a message calls a file whose rows find no room.
std::string reading_words(const FilePlan& plan, const std::filesystem::path& path) {
  std::error_code unknown; // what is no file is told by who reads it
  const auto bytes = std::filesystem::file_size(path, unknown);
  if (unknown) return "reading " + plan.file;
  return fmt::format("reading {} ({})", plan.file, human_bytes(static_cast<double>(bytes)));
}

// A file's own rows and columns, by experiment.
void read_part(Part& part, const FilePlan& plan) {
  const std::string& file = plan.file;
  const std::string& label = plan.label;
  const DataOptions& options = plan.options;
  const auto path = std::filesystem::path(options.base) / file;
  large_work(reading_words(plan, path), 0, fewer_rows, [&] {
    part.raw = read_raw(path.string(), file, options, part.faults);
    if (!options.wide.empty()) part.raw = from_wide(part.raw, options.wide, options.wide_place);
    gather_experiments(part, map_columns(part.raw, options, label, part.faults), label);
    take_slopes(part, options);
  });
}

void finish_part(Part& part, const DataOptions& options, const Beside& beside) {
  if (beside.tests) add_test_columns(part, *beside.tests);
  if (beside.second) join_clocks(part, *beside.second, options.join);
  compute_formulas(part, options);
  multiply_coefficients(part, options);
  check_needed(part, options);
  derive_shear_stress(part, options);
  drop_missing(part, options);
  drop_rows(part, options);
  tell_cells(part);
  check_values(part);
  check_experiments(part, options);
  integrate_distance(part);
  check_computed(part);
}

Part load_part(const FilePlan& plan, const Beside& beside) {
  Part part;
  try {
    read_part(part, plan);
    finish_part(part, plan.options, beside);
  } catch (const InputError& error) {
    part.faults.add(error);
  }
  return part;
}

// Of the second set: what its files hold.
Part load_second_part(const FilePlan& plan) {
  Part part;
  try {
    read_part(part, plan);
    compute_formulas(part, plan.options);
    multiply_coefficients(part, plan.options);
    drop_missing(part, plan.options);
    tell_cells(part);
    check_values(part);
    check_computed(part);
  } catch (const InputError& error) {
    part.faults.add(error);
  }
  return part;
}

// The faults of each file by line; those that several files have alike, of the first.
void throw_faults(const std::vector<Part>& parts) {
  FaultsByCause causes;
  for (const Part& part : parts) {
    std::vector<Fault> sorted = part.faults.all();
    std::stable_sort(sorted.begin(), sorted.end(), [](const Fault& a, const Fault& b) {
      return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
    });
    for (const Fault& fault : sorted)
      causes.add(fault.what + fault.hint, fault);
  }
  FaultList faults;
  causes.tell(faults, parts.size() > 1 ? "place" : "row");
  faults.throw_if_any();
}

Dataset one_campaign(std::vector<Part>& parts, const std::vector<std::string>& files) {
  FaultList faults;
  Dataset all = std::move(parts.front().data);
  all.sources = {files.front()};
  for (std::size_t i = 1; i < parts.size(); ++i) {
    append(all, std::move(parts[i].data), files[i], faults);
    faults.throw_if_any();
    all.sources.push_back(files[i]);
  }
  return all;
}

template <class Load>
Dataset load_all(const std::vector<std::string>& named, const DataOptions& options,
                 const Load& load) {
  const std::vector<std::string> files = find_files(named, options.base, options.place);
  const FilePlans plans = plan_files(files, options);
  std::vector<Part> parts(files.size());
  parallel_for(files.size(), [&](std::size_t i) { parts[i] = load(plans.files[i]); });
  throw_faults(parts);
  Dataset all = one_campaign(parts, files);
  all.notes.insert(all.notes.begin(), plans.notes.begin(), plans.notes.end());
  return all;
}

// The files of data.join, read with its own keys.
Dataset load_second(const DataOptions& options) {
  DataOptions own;
  own.base = options.base;
  own.place = options.join.place;
  own.missing = options.missing;
  own.files = {options.join.how};
  own.files.front().match = "*";
  return load_all(options.join.files, own, load_second_part);
}

// Tests that stand beside the data and are in none of these files.
std::vector<std::string> unused_tests(const Dataset& data, const Beside& beside) {
  std::vector<std::string> unused;
  const auto add = [&](const std::string& where, const std::string& name) {
    const auto& used = data.experiments;
    if (std::find(used.begin(), used.end(), name) == used.end())
      unused.push_back(where + ": " + name);
  };
  if (beside.tests)
    for (const auto& [name, row] : beside.tests->row)
      add(beside.tests->file, name);
  if (beside.second)
    for (const std::string& name : beside.second->experiments)
      add("data.join", name);
  return unused;
}

} // namespace

Dataset load_dataset(const std::vector<std::string>& named, const DataOptions& options) {
  DataOptions rest = options; // without what stands in the table of tests
  Beside beside;
  if (!options.tests.empty()) beside.tests = read_test_table(rest);
  if (!options.join.files.empty()) beside.second = load_second(options);
  Dataset all =
      load_all(named, rest, [&](const FilePlan& plan) { return load_part(plan, beside); });
  if (all.rows() == 0)
    throw InputError(options.join.place,
                     "data.join leaves no row: no test has a partner at the same time",
                     "tests are known by their names, as the files are called or from_name says; "
                     "offset is added to the clock of data.join");
  if (std::string text = clocks_text(all.clocks, options.join); !text.empty())
    all.notes.push_back(std::move(text));
  all.unused = unused_tests(all, beside);
  fingerprint(all);
  return all;
}

} // namespace frictab::data
