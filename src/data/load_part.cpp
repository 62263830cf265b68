// Maps, gathers experiments, joins, computes, leaves out and checks one file; appends files.
#include "data/load_part.h"

#include <algorithm>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "core/large_work.h"
#include "core/parallel.h"
#include "core/text.h"
#include "data/append.h"
#include "data/checks.h"
#include "data/computed.h"
#include "data/join.h"
#include "data/leave_out.h"
#include "data/recordings.h"
#include "data/signs.h"
#include "data/wide.h"

namespace frictab::data {

std::string reading_words(const FilePlan& plan) {
  std::error_code unknown; // reading the file reports the error
  const auto bytes = std::filesystem::file_size(path_of(plan), unknown);
  if (unknown) return "reading " + plan.name;
  return fmt::format("reading {} ({})", plan.name, human_bytes(static_cast<double>(bytes)));
}

namespace {

// Maps a file's own rows and columns from part.raw and groups them by experiment.
void map_part(Part& part, const FilePlan& plan) {
  gather_experiments(part, map_columns(part.raw, plan.options, plan.label, part.faults),
                     plan.label);
  drop_empty_rows(part, plan.options);
  take_slopes(part, plan.options);
}

void read_part(Part& part, const FilePlan& plan) {
  const Reading& options = plan.options;
  large_work(reading_words(plan), 0, fewer_rows, [&] {
    part.raw =
        end_to_end(read_raw(path_of(plan).string(), plan.name, options, part.faults), options);
    map_part(part, plan);
  });
}

bool lacks_stress(Part& part, const Reading& options) {
  return !part.find("sigma_n_MPa") || (options.measured && !part.find("tau_R_MPa"));
}

void finish_part(Part& part, const Reading& options, const Beside& beside) {
  if (beside.tests) add_test_columns(part, *beside.tests);
  if (beside.second) join_clocks(part, *beside.second, options.join);
  compute_formulas(part, options);
  multiply_coefficients(part, options);
  check_needed(part, options);
  turn_loads(part);
  derive_shear_stress(part, options);
  drop_missing(part, options);
  drop_rows(part, options);
  report_odd_cells(part);
  check_experiments(part, options);
  if (lacks_stress(part, options)) return; // as is reported already
  const std::vector<Phase> phases = take_signs(part, options);
  integrate_distance(part); // over all rows
  leave_out_phases(part, phases, options);
  check_values(part, options);
  check_computed(part, options);
  leave_out_impossible(part, options);
  part.data.file_of.assign(part.data.experiments.size(), part.raw.file);
}

// The part returned by `load`, or an empty part with the fault it threw.
template <class Load> Part loaded(const Load& load) {
  Part part;
  try {
    load(part);
  } catch (const InputError& error) {
    part.faults.add(error);
  }
  part.raw = {}; // its rows have been checked
  std::vector<std::size_t>().swap(part.row);
  return part;
}

// Reads the files of data.join with its own keys.
Dataset load_second(const DataOptions& options) {
  Reading own;
  own.base = options.base;
  own.place = options.join.place;
  own.missing = options.missing;
  own.files = {options.join.how};
  own.files.front().match = "*";
  return load_all(options.join.files, own, load_plain_part);
}

} // namespace

Part load_plain_part(const FilePlan& plan) {
  return loaded([&](Part& part) {
    read_part(part, plan);
    compute_formulas(part, plan.options);
    multiply_coefficients(part, plan.options);
    drop_missing(part, plan.options);
    forget_signed(part);
    report_odd_cells(part);
    check_values(part, plan.options);
    check_computed(part, plan.options);
  });
}

Part load_part(const FilePlan& plan, const Beside& beside) {
  return loaded([&](Part& part) {
    read_part(part, plan);
    finish_part(part, plan.options, beside);
  });
}

Part load_part(io::CsvTable&& raw, const FilePlan& plan, const Beside& beside) {
  return loaded([&](Part& part) {
    part.raw = std::move(raw);
    part.whole_file = false;
    map_part(part, plan);
    finish_part(part, plan.options, beside);
  });
}

Beside load_beside(Reading& options) {
  Beside beside;
  const auto know = [&](const std::vector<Column>& columns) {
    for (const Column& column : columns)
      options.columns_beside.insert(column.name);
  };
  if (!options.tests.empty()) {
    beside.tests = read_test_table(options);
    know(beside.tests->columns.columns);
  }
  if (!options.join.files.empty()) {
    beside.second = load_second(options);
    know(beside.second->columns);
  }
  return beside;
}

namespace {

// Tests of data.tests and data.join without a row in any file.
std::vector<std::string> unused_tests(const Dataset& data, const Beside& beside) {
  std::vector<std::string> unused;
  std::set<std::string> used(data.experiments.begin(), data.experiments.end());
  const auto add = [&](const std::string& where, const std::string& name) {
    if (used.count(name) == 0) unused.push_back(where + ": " + name);
  };
  if (beside.second)
    for (const std::string& name : beside.second->experiments)
      add("data.join", name);
  if (!beside.tests) return unused;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    if (const std::string* const name = beside.tests->name_of(data, e)) used.insert(*name);
  for (const auto& [name, row] : beside.tests->row)
    add(beside.tests->file, name);
  return unused;
}

} // namespace

void complete(Dataset& all, const ReadRequest& options, const Beside& beside) {
  if (all.rows() == 0)
    throw InputError(options.join.place,
                     "data.join leaves no row: no test has a partner at the same time",
                     "tests are known by their names, as the files are called or from_name says; "
                     "offset is added to the clock of data.join");
  if (std::string text = clocks_text(all.clocks, options.join); !text.empty())
    all.notes.push_back(std::move(text));
  if (beside.second)
    for (const Dataset::Dropped& dropped : beside.second->dropped)
      all.notes.push_back(
          fmt::format("data.join: {} {} left out ({}): its columns are interpolated "
                      "between those before and after",
                      thousands(dropped.rows), dropped.rows == 1 ? "row" : "rows", dropped.rule));
  if (beside.tests) check_numbered(*beside.tests, all);
  report_rows_left_out(all);
  report_signs(all, options.force_zero);
  all.unused = unused_tests(all, beside);
  find_recordings(all, options);
  const auto assume = [&](const std::vector<AssumedUnit>& units) {
    all.assumed.insert(all.assumed.end(), units.begin(), units.end());
  };
  if (beside.tests) assume(beside.tests->columns.assumed);
  if (beside.second) assume(beside.second->assumed);
  fingerprint(all);
}

void throw_faults(const std::vector<FaultList>& of_files) {
  FaultsByCause causes;
  for (const FaultList& one : of_files) {
    std::vector<Fault> sorted = one.all();
    std::stable_sort(sorted.begin(), sorted.end(), [](const Fault& a, const Fault& b) {
      return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
    });
    for (const Fault& fault : sorted)
      causes.add(fault.what + fault.hint, fault);
  }
  FaultList faults;
  causes.tell(faults, of_files.size() > 1 ? "place" : "row");
  faults.throw_if_any();
}

namespace {

Dataset one_campaign(std::vector<Part>& parts, const std::vector<std::string>& files) {
  FaultList faults;
  CountedNotes counted;
  for (Part& part : parts)
    if (parts.size() > 1) counted.take(part);
  std::size_t first = 0; // first part with a row left
  while (first + 1 < parts.size() && parts[first].data.rows() == 0)
    ++first;
  Dataset all = std::move(parts[first].data);
  all.sources = {files[first]}; // named by faults of the others
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i == first) continue;
    if (parts[i].data.rows() == 0) {
      absorb(all, parts[i].data);
      continue;
    }
    append(all, std::move(parts[i].data), files[i], faults);
    parts[i] = {};
    faults.throw_if_any();
  }
  all.sources = files;
  for (std::string& note : counted.texts())
    all.notes.push_back(std::move(note));
  return all;
}

} // namespace

Dataset load_all(const std::vector<std::string>& named, const Reading& options,
                 const std::function<Part(const FilePlan&)>& load) {
  const std::vector<std::string> files = find_files(named, options.base, options.place);
  const FilePlans plans = plan_files(files, options);
  std::vector<Part> parts(plans.files.size());
  parallel_for(parts.size(), [&](std::size_t i) { parts[i] = load(plans.files[i]); });
  std::vector<FaultList> faults;
  for (Part& part : parts)
    faults.push_back(std::move(part.faults));
  throw_faults(faults);
  Dataset all = one_campaign(parts, names_of(plans));
  all.notes.insert(all.notes.begin(), plans.notes.begin(), plans.notes.end());
  return all;
}

} // namespace frictab::data
