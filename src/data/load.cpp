// From files to a campaign: map, gather experiments, leave out, derive, check, join.
#include "data/load.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "core/parallel.h"
#include "core/text.h"
#include "data/file_list.h"
#include "data/mapping.h"
#include "data/quantity.h"

namespace frictab::data {

namespace fs = std::filesystem;

namespace {

// One file as a campaign, with the raw row of each of its rows.
struct Part {
  Dataset data;
  io::CsvTable raw;
  std::vector<std::size_t> row; // raw row
  bool measured_tau = true;
  FaultList faults;
  std::vector<MappedFile::CellFault> cell_faults; // not told yet

  Column* find(std::string_view name) {
    for (Column& column : data.columns)
      if (column.name == name) return &column;
    return nullptr;
  }
  Place place(std::size_t i) const { return row_place(raw, row[i]); }
};

// Orders rows so that each experiment is contiguous, in order of first appearance.
void gather_experiments(Part& part, MappedFile&& mapped, const std::string& file_name) {
  Dataset& data = part.data;
  const std::size_t rows = part.raw.rows();
  std::map<std::string, std::size_t> index;
  std::vector<std::vector<std::size_t>> members;
  const auto name_of = [&](std::size_t i) -> const std::string& {
    return mapped.experiment.empty() ? file_name : mapped.experiment[i];
  };
  std::size_t current = 0; // rows of one experiment mostly follow each other
  for (std::size_t i = 0; i < rows; ++i) {
    const std::string& name = name_of(i);
    if (i > 0 && name == name_of(i - 1)) {
      members[current].push_back(i);
      continue;
    }
    const auto [found, is_new] = index.emplace(name, members.size());
    if (is_new) {
      members.emplace_back();
      data.experiments.push_back(name);
    }
    current = found->second;
    members[current].push_back(i);
  }
  for (const auto& rows_of_one : members) {
    part.row.insert(part.row.end(), rows_of_one.begin(), rows_of_one.end());
    data.first_row.push_back(part.row.size());
  }
  for (Column& column : mapped.columns) {
    Column sorted{column.name, column.unit, std::vector<double>(rows), column.levels};
    for (std::size_t i = 0; i < rows; ++i)
      sorted.values[i] = column.values[part.row[i]];
    data.columns.push_back(std::move(sorted));
  }
  data.notes = std::move(mapped.notes);
  part.cell_faults = std::move(mapped.cell_faults);
}

// Slope of the least-squares line of y over t in a window of `width` rows around each row.
std::vector<double> local_slopes(std::span<const double> t, std::span<const double> y,
                                 std::size_t width) {
  std::vector<double> slopes(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    const std::size_t half = width / 2;
    const std::size_t begin =
        i > half ? std::min(i - half, t.size() - std::min(width, t.size())) : 0;
    const std::size_t end = std::min(begin + width, t.size());
    double mt = 0, my = 0, stt = 0, sty = 0;
    const double n = static_cast<double>(end - begin);
    for (std::size_t j = begin; j < end; ++j) {
      mt += t[j] / n;
      my += y[j] / n;
    }
    for (std::size_t j = begin; j < end; ++j) {
      stt += (t[j] - mt) * (t[j] - mt);
      sty += (t[j] - mt) * (y[j] - my);
    }
    slopes[i] = sty / stt; // NaN where time stands still
  }
  return slopes;
}

void take_slopes(Part& part, const DataOptions& options) {
  for (const auto& [canonical, from] : options.columns) {
    if (from.slope_rows == 0) continue;
    Column* column = part.find(canonical);
    const Column* time = part.find("time_s");
    if (!column) continue;
    if (!time) {
      part.faults.add(from.place, canonical + ": a slope needs time_s, which the data do not have");
      continue;
    }
    for (std::size_t e = 0; e < part.data.experiments.size(); ++e) {
      const std::size_t first = part.data.first_row[e], n = part.data.first_row[e + 1] - first;
      const auto slopes = local_slopes({time->values.data() + first, n},
                                       {column->values.data() + first, n}, from.slope_rows);
      for (std::size_t i = 0; i < n; ++i)
        column->values[first + i] = std::abs(slopes[i]);
    }
    part.data.notes.push_back(
        fmt::format("{} = slope over {} rows of its column", canonical, from.slope_rows));
  }
}

// Eq. 1 of the paper: mu_meas = F_R/F_N, tau_R = mu_meas sigma_N.
void derive_shear_stress(Part& part) {
  if (part.find("tau_R_MPa")) return;
  const Column* friction = part.find("F_R_N");
  const Column* normal = part.find("F_N_N");
  const Column* stress = part.find("sigma_n_MPa");
  const Place header{part.raw.file, part.raw.header_line, 0};
  if (!friction || !normal) {
    std::vector<std::string> present;
    for (const io::CsvColumn& column : part.raw.columns)
      if (!column.name.empty()) present.push_back(column.name);
    part.faults.add(header, "there is neither tau_R_MPa nor the pair F_R_N, F_N_N",
                    "map it in [data.columns]; the file has: " + join(present, ", "));
    return;
  }
  if (!stress) return; // told by check_needed
  Column tau{"tau_R_MPa", "MPa", std::vector<double>(stress->values.size()), {}};
  part.measured_tau = false;
  // No load, no coefficient: NaN; check_values reports the load unless the row is left out before.
  for (std::size_t i = 0; i < tau.values.size(); ++i)
    tau.values[i] = normal->values[i] > 0
                        ? friction->values[i] / normal->values[i] * stress->values[i]
                        : std::numeric_limits<double>::quiet_NaN();
  part.data.columns.push_back(std::move(tau));
  part.data.notes.push_back("tau_R_MPa = F_R_N/F_N_N * sigma_n_MPa (eq. 1)");
}

// The rows whose `keep` is not 0; an experiment without a row goes.
void keep_rows(Part& part, const std::vector<char>& keep, const char* if_none) {
  Dataset& data = part.data;
  std::vector<std::size_t> first{0};
  std::vector<std::string> names;
  std::vector<std::size_t> kept;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
      if (keep[i]) kept.push_back(i);
    if (kept.size() == first.back()) continue; // nothing of it is left
    names.push_back(data.experiments[e]);
    first.push_back(kept.size());
  }
  if (kept.size() == part.row.size()) return;
  if (kept.empty() && part.faults.empty()) part.faults.add({part.raw.file, 0, 0}, if_none);
  for (Column& column : data.columns) {
    std::vector<double> values;
    for (const std::size_t i : kept)
      values.push_back(column.values[i]);
    column.values = std::move(values);
  }
  std::vector<std::size_t> row;
  for (const std::size_t i : kept)
    row.push_back(part.row[i]);
  part.row = std::move(row);
  data.experiments = std::move(names);
  data.first_row = std::move(first);
}

// Rows left out at the user's word, before anything is checked.
void drop_rows(Part& part, const DataOptions& options) {
  std::vector<char> keep(part.row.size(), 1);
  for (const DropRule& rule : options.drop) {
    const Column* column = part.find(rule.column);
    if (!column) {
      part.faults.add(rule.place,
                      fmt::format("data.drop: the data have no column {}", rule.column));
      continue;
    }
    std::size_t dropped = 0;
    for (std::size_t i = 0; i < keep.size(); ++i) {
      const double x = column->values[i];
      const bool out = (rule.below && x < *rule.below) || (rule.above && x > *rule.above);
      dropped += out && keep[i];
      if (out) keep[i] = 0;
    }
    std::string text = rule.column;
    if (rule.below) text += " below " + shortest(*rule.below);
    if (rule.above)
      text += std::string(rule.below ? " or" : "") + " above " + shortest(*rule.above);
    part.data.dropped.push_back({text, dropped});
  }
  keep_rows(part, keep, "data.drop leaves no row");
}

// Rows with an empty cell where the job leaves them out.
void drop_missing(Part& part, const DataOptions& options) {
  if (options.missing != Missing::drop) return;
  std::set<std::size_t> raw_rows;
  for (const MappedFile::CellFault& cell : part.cell_faults)
    if (cell.missing) raw_rows.insert(cell.row);
  if (raw_rows.empty()) return;
  std::vector<char> keep;
  for (const std::size_t row : part.row)
    keep.push_back(raw_rows.count(row) == 0);
  part.data.dropped.push_back({"an empty cell", raw_rows.size()});
  keep_rows(part, keep, "data.missing = \"drop\" leaves no row");
}

// Faults of cells in the rows that are kept; what was to be computed from such a cell follows them.
void tell_cells(Part& part) {
  if (part.cell_faults.empty()) return;
  const std::set<std::size_t> kept(part.row.begin(), part.row.end());
  for (MappedFile::CellFault& cell : part.cell_faults)
    if (kept.count(cell.row) > 0)
      part.faults.add(cell.fault.place, cell.fault.what, cell.fault.hint);
  part.cell_faults.clear();
}

// A value that could not be computed though every cell of its row is a number.
void check_computed(Part& part) {
  if (!part.faults.empty()) return;
  for (const Column& column : part.data.columns)
    for (std::size_t i = 0; find_quantity(column.name) && i < column.values.size(); ++i)
      if (!std::isfinite(column.values[i]))
        part.faults.add(part.place(i), column.name + " cannot be computed here",
                        "time stands still, a neighbouring row holds no number, or the numbers "
                        "are too large");
}

void check_values(Part& part) {
  for (const Column& column : part.data.columns) {
    const Quantity* quantity = find_quantity(column.name);
    if (!quantity) continue;
    for (std::size_t i = 0; i < column.values.size(); ++i) {
      if (column.name == "F_N_N" && !part.measured_tau && column.values[i] == 0)
        part.faults.add(part.place(i), "F_N_N is 0: there is no friction coefficient",
                        "leave rows without load out: data.drop = { F_N_N = { below = 1 } }");
      if (!(column.values[i] < quantity->lowest)) continue;
      std::string hint =
          fmt::format("a {} cannot be below {}{}", quantity->meaning, quantity->lowest,
                      quantity->unit == "1" ? "" : " " + quantity->unit);
      if (quantity->lowest == 0)
        hint += fmt::format("; leave such rows out with data.drop = {{ {} = {{ below = 0 }} }}",
                            column.name);
      part.faults.add(part.place(i), fmt::format("{} is {}", column.name, column.values[i]), hint);
    }
  }
}

void check_experiments(Part& part) {
  const Dataset& data = part.data;
  const Column* time = part.find("time_s");
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const std::size_t first = data.first_row[e], end = data.first_row[e + 1];
    if (end - first < 2)
      part.faults.add(part.place(first),
                      fmt::format("experiment '{}' has one row only", data.experiments[e]),
                      "an experiment is a time series; is this the right experiment column?");
    for (std::size_t i = first + 1; time && i < end; ++i)
      if (time->values[i] < time->values[i - 1]) {
        part.faults.add(part.place(i),
                        fmt::format("time_s goes back from {} to {} inside experiment '{}'",
                                    time->values[i - 1], time->values[i], data.experiments[e]),
                        "rows are in time order; is this two experiments?");
        break; // once per experiment
      }
  }
}

// A column that is mapped and absent has had its fault already.
void check_needed(Part& part, const DataOptions& options) {
  std::vector<std::string> present;
  for (const io::CsvColumn& column : part.raw.columns)
    if (!column.name.empty()) present.push_back(column.name);
  if (!part.find("sigma_n_MPa") && !options.columns.count("sigma_n_MPa"))
    part.faults.add({part.raw.file, part.raw.header_line, 0}, "there is no column sigma_n_MPa",
                    "map it in [data.columns], or give it in [data.constants]; the file has: " +
                        join(present, ", "));
}

void integrate_distance(Part& part) {
  const Column* speed = part.find("v_rel_mm_s");
  const Column* time = part.find("time_s");
  if (part.find("s_mm") || !speed || !time) return;
  Column distance{"s_mm", "mm", std::vector<double>(speed->values.size()), {}};
  for (std::size_t e = 0; e < part.data.experiments.size(); ++e)
    for (std::size_t i = part.data.first_row[e] + 1; i < part.data.first_row[e + 1]; ++i)
      distance.values[i] = distance.values[i - 1] + 0.5 *
                                                        (speed->values[i] + speed->values[i - 1]) *
                                                        (time->values[i] - time->values[i - 1]);
  part.data.columns.push_back(std::move(distance));
  part.data.notes.push_back("s_mm integrated from v_rel_mm_s and time_s");
}

Part load_part(const FilePlan& plan) {
  const auto& [file, label, options] = plan;
  Part part;
  const fs::path path = options.base.empty() ? fs::path(file) : fs::path(options.base) / file;
  try {
    part.raw = read_raw(path.string(), file, options, part.faults);
    MappedFile mapped = map_columns(part.raw, options, label, part.faults);
    gather_experiments(part, std::move(mapped), label);
    check_needed(part, options);
    take_slopes(part, options);
    derive_shear_stress(part);
    drop_missing(part, options);
    drop_rows(part, options);
    tell_cells(part);
    check_values(part);
    check_experiments(part);
    integrate_distance(part);
    check_computed(part);
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults())
      part.faults.add(fault.place, fault.what, fault.hint);
  }
  return part;
}

// Appends `more` to `all`: same columns, text levels joined, experiments told apart.
void append(Dataset& all, Dataset&& more, const std::string& file, FaultList& faults) {
  for (const std::string& name : more.experiments)
    if (std::find(all.experiments.begin(), all.experiments.end(), name) != all.experiments.end())
      faults.add({file, 0, 0}, fmt::format("experiment '{}' is in another file as well", name),
                 "give experiments different names, or join the files");
  for (const Column& column : more.columns)
    if (!all.find(column.name))
      faults.add({file, 0, 0}, fmt::format("column {} is not in {}", column.name, all.sources[0]),
                 "all files of a list need the same columns; see data.bystanders");
  for (Column& column : all.columns) {
    const Column* other = more.find(column.name);
    if (!other) {
      faults.add({file, 0, 0},
                 fmt::format("there is no column {}, which {} has", column.name, all.sources[0]),
                 "all files of a list need the same columns; see data.bystanders");
      continue;
    }
    if (column.levels.empty() != other->levels.empty()) {
      faults.add({file, 0, 0},
                 fmt::format("column {} is text in one file and numbers in another", column.name));
      continue;
    }
    std::vector<std::string> levels = column.levels;
    levels.insert(levels.end(), other->levels.begin(), other->levels.end());
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    const auto recode = [&](const Column& from, double code) {
      if (levels.empty()) return code;
      const std::string& level = from.levels[static_cast<std::size_t>(code)];
      return static_cast<double>(std::lower_bound(levels.begin(), levels.end(), level) -
                                 levels.begin());
    };
    for (double& value : column.values)
      value = recode(column, value);
    for (const double value : other->values)
      column.values.push_back(recode(*other, value));
    column.levels = std::move(levels);
  }
  const std::size_t offset = all.first_row.back();
  all.experiments.insert(all.experiments.end(), more.experiments.begin(), more.experiments.end());
  for (std::size_t e = 1; e < more.first_row.size(); ++e)
    all.first_row.push_back(offset + more.first_row[e]);
  for (const Dataset::Dropped& dropped : more.dropped) {
    const auto same = std::find_if(all.dropped.begin(), all.dropped.end(),
                                   [&](const auto& there) { return there.rule == dropped.rule; });
    if (same == all.dropped.end())
      all.dropped.push_back(dropped);
    else
      same->rows += dropped.rows;
  }
  for (std::string& note : more.notes)
    if (std::find(all.notes.begin(), all.notes.end(), note) == all.notes.end())
      all.notes.push_back(std::move(note));
}

} // namespace

Dataset load_dataset(const std::vector<std::string>& named, const DataOptions& options) {
  const std::vector<std::string> files = find_files(named, options.base, options.place);
  const FilePlans plans = plan_files(files, options);
  std::vector<Part> parts(files.size());
  parallel_for(files.size(), [&](std::size_t i) { parts[i] = load_part(plans.files[i]); });
  FaultList faults;
  for (const Part& part : parts) {
    try {
      part.faults.throw_if_any();
    } catch (const InputError& error) {
      std::vector<Fault> sorted = error.faults();
      std::stable_sort(sorted.begin(), sorted.end(), [](const Fault& a, const Fault& b) {
        return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
      });
      for (const Fault& fault : sorted)
        faults.add(fault.place, fault.what, fault.hint);
    }
  }
  faults.throw_if_any();
  Dataset all = std::move(parts.front().data);
  all.sources = {files.front()};
  for (std::size_t i = 1; i < parts.size(); ++i) {
    append(all, std::move(parts[i].data), files[i], faults);
    faults.throw_if_any();
    all.sources.push_back(files[i]);
  }
  all.notes.insert(all.notes.begin(), plans.notes.begin(), plans.notes.end());
  fingerprint(all);
  return all;
}

} // namespace frictab::data
