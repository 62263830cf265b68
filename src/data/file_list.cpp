// Expands globs and folders; names are read by regular expressions.
#include "data/file_list.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/no_value.h"
#include "core/os/files.h"
#include "core/pattern.h"
#include "core/text.h"
#include "data/quantity.h"
#include "data/workbooks.h"
#include "io/number.h"
#include "io/workbook.h"

namespace frictab::data {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view glob_signs = "*?[";

fs::path inside(const std::string& base, const std::string& name) {
  return base.empty() ? fs::path(name) : fs::path(base) / name;
}

// Escapes a folder's own name, which is not a pattern even if it contains glob characters.
std::string without_signs(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (glob_signs.find(c) != glob_signs.npos || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

// Hidden files, locks of open workbooks and indices of TDMS files.
bool is_by_product(const std::string& name) {
  return name.starts_with('.') || name.starts_with("~$") || name.ends_with(".tdms_index");
}

std::vector<std::string> matching(const std::string& pattern, const std::string& base) {
  const std::string whole = fs::path(pattern).is_absolute() || base.empty()
                                ? pattern
                                : without_signs(base) + "/" + pattern;
  std::vector<std::string> names;
  for (const fs::path path : os::paths_like(whole))
    if (fs::is_regular_file(path) && !is_by_product(path.filename().string()))
      names.push_back(base.empty() || fs::path(pattern).is_absolute()
                          ? path.string()
                          : path.lexically_relative(base).string());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> files_in(const std::string& folder, const std::string& base) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(inside(base, folder))) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && !is_by_product(name))
      names.push_back((fs::path(folder) / name).lexically_normal().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// ---- rules ----

// `sheet`: of a workbook, by its name or as "tests.xlsx/T01"; empty: the file as a whole.
bool fits(const FileRule& rule, const std::string& file, const std::string& sheet = "") {
  const bool with_folder = rule.match.find('/') != std::string::npos;
  const std::string own = fs::path(file).filename().string();
  if (os::is_like(with_folder ? file : own, rule.match)) return true;
  if (sheet.empty()) return false;
  if (!with_folder) return os::is_like(sheet, rule.match);
  return os::is_like(file + "/" + sheet, rule.match) || os::is_like(own + "/" + sheet, rule.match);
}

// Index of the first matching rule; number of rules if none matches.
std::size_t rule_of(const std::string& file, const DataOptions& options,
                    const std::string& sheet = "") {
  std::size_t i = 0;
  while (i < options.files.size() && !fits(options.files[i], file, sheet))
    ++i;
  return i;
}

void apply_dialect(const FileRule& rule, DataOptions& options) {
  if (rule.delimiter) options.delimiter = *rule.delimiter;
  if (rule.decimal) options.decimal = *rule.decimal;
  if (rule.thousands) options.thousands = *rule.thousands;
  if (rule.skip_rows) options.skip_rows = *rule.skip_rows;
  if (rule.skip_footer) options.skip_footer = *rule.skip_footer;
  if (rule.units_row) options.units_row = *rule.units_row;
  if (rule.header) options.header = rule.header;
  if (rule.header_rows) options.header_rows = *rule.header_rows;
}

void apply(const FileRule& rule, DataOptions& options) {
  apply_dialect(rule, options);
  if (!rule.segments.begins.empty()) options.segments = rule.segments;
  if (!rule.sheets.empty()) options.sheets = rule.sheets;
  for (const auto& [name, source] : rule.columns) {
    options.columns[name] = source;
    options.constants.erase(name);
  }
  for (const auto& [name, value] : rule.constants) {
    options.constants[name] = value;
    options.columns.erase(name);
  }
  options.labels.insert(rule.labels.begin(), rule.labels.end());
  if (!rule.experiment.empty()) options.experiment = rule.experiment;
}

// The rule of the table of tests; nullptr if there is none.
const FileRule* rule_of_tests(const DataOptions& options) {
  const std::string name = fs::path(options.tests).filename().string();
  for (const FileRule& rule : options.files)
    if (!options.tests.empty() && (rule.match == options.tests || rule.match == name)) return &rule;
  return nullptr;
}

// ---- contents of names ----

// Parses a number in a name. The decimal sign may be a point, a comma or p (2p5), and with `dash`
// also a - between digits (0-8).
bool is_number(const std::string& text, bool dash, double& value) {
  for (const char decimal : {'.', ','})
    if (io::read_number(text, decimal, value)) return true;
  constexpr const char* digits = "0123456789";
  const std::size_t sign = text.find_first_not_of(digits);
  if (sign == 0 || sign == text.npos || sign + 1 == text.size() ||
      text.find_first_not_of(digits, sign + 1) != text.npos)
    return false;
  const char between = text[sign];
  if (between != 'p' && between != 'P' && !(dash && between == '-')) return false;
  return io::read_number(text.substr(0, sign) + "." + text.substr(sign + 1), '.', value);
}

// Interprets dashes: 1-2 together with 2-3 is a range or a date; 0-5, or 2-5 together with 1 and
// 10, is a number.
bool dash_is_decimal(const std::set<std::string>& levels) {
  double value = 0;
  return std::any_of(levels.begin(), levels.end(), [&](const std::string& text) {
    return text.starts_with("0-") || is_number(text, false, value);
  });
}

using NamedGroups = std::map<std::string, std::string>;

NamedGroups groups_of(const FileRule& rule, const Pattern& pattern, const std::string& file) {
  const auto found = pattern.search(file);
  if (!found)
    throw InputError(rule.from_name_place,
                     fmt::format("'{}' does not fit '{}'", rule.from_name, file),
                     "a pattern that fits the names of all files of this rule, or a rule of its "
                     "own for those that it does not");
  return *found;
}

// The named groups of one rule's files, as columns of these files.
class FromNames {
public:
  FromNames(const FileRule& rule, std::vector<FilePlan*> files)
      : rule_(rule), files_(std::move(files)) {
    const Pattern pattern(rule.from_name, rule.from_name_place);
    for (const FilePlan* plan : files_)
      groups_.push_back(groups_of(rule, pattern, plan->name));
    for (const std::string& name : pattern.names())
      name == "experiment" ? take_label() : take(name);
  }

  const std::vector<std::string>& notes() const { return notes_; } // "radius_mm (2: 10, 12)"

private:
  void take_label() {
    for (std::size_t i = 0; i < files_.size(); ++i)
      if (const std::string& label = groups_[i].at("experiment"); !label.empty())
        files_[i]->label = label;
  }

  // Reads the groups of a name. A group that took no part gives no value for that file: a quantity
  // is then taken from the file's own column or is missing, any other column is empty.
  void take(const std::string& name) {
    std::set<std::string> levels;
    for (const NamedGroups& groups : groups_)
      levels.insert(groups.at(name));
    const bool gaps = levels.erase("") > 0;
    if (levels.empty())
      throw InputError(rule_.from_name_place,
                       fmt::format("'{}' finds {} in no name, as in '{}'", rule_.from_name, name,
                                   files_.front()->name),
                       "a group that is there in some names at least");
    const Quantity* quantity = find_quantity(name);
    const bool dash = quantity || dash_is_decimal(levels);
    if (quantity) check(*quantity);
    double value = 0;
    // days that tests share order them as a text only
    const bool numbers =
        name != "date" && std::all_of(levels.begin(), levels.end(), [&](const std::string& text) {
          return is_number(text, dash, value);
        });
    for (std::size_t i = 0; i < files_.size(); ++i) {
      const std::string& text = groups_[i].at(name);
      DataOptions& options = files_[i]->options;
      if (text.empty() && quantity) continue;
      if (numbers)
        options.constants[name] = is_number(text, dash, value) ? value : no_value;
      else
        options.labels[name] = text;
      options.columns.erase(name);
    }
    tell(name, levels, numbers && dash, gaps);
  }

  void tell(const std::string& name, const std::set<std::string>& levels, bool dash, bool gaps) {
    constexpr std::size_t shown = 6;
    std::vector<std::string> list;
    for (const std::string& text : levels) {
      double plain = 0, value = 0;
      const bool read = is_number(text, dash, value) && !io::read_number(text, '.', plain) &&
                        !io::read_number(text, ',', plain);
      list.push_back(read ? fmt::format("{} = {}", text, shortest(value)) : text);
    }
    if (list.size() > shown) {
      list.resize(shown);
      list.emplace_back("...");
    }
    if (gaps) list.emplace_back("none in some names");
    notes_.push_back(fmt::format("{} ({}: {})", name, levels.size(), join(list, ", ")));
  }

  void check(const Quantity& quantity) const {
    for (std::size_t i = 0; i < files_.size(); ++i) {
      const std::string& text = groups_[i].at(quantity.name);
      double value = 0;
      if (!text.empty() && (!is_number(text, true, value) || value < quantity.lowest))
        throw InputError(
            rule_.from_name_place,
            fmt::format("{} is '{}' in the name of {}", quantity.name, text, files_[i]->name),
            fmt::format("a {} is a number, at least {}, in {}", quantity.meaning,
                        shortest(quantity.lowest), quantity.unit));
    }
  }

  const FileRule& rule_;
  std::vector<FilePlan*> files_;
  std::vector<NamedGroups> groups_;
  std::vector<std::string> notes_;
};

std::string note_of(const FileRule& rule, std::size_t files,
                    const std::vector<std::string>& names) {
  std::vector<std::string> parts;
  for (const auto& [name, source] : rule.columns)
    parts.push_back(name + " from a column of its own");
  for (const auto& [name, value] : rule.constants)
    parts.push_back(name + " = " + shortest(value));
  for (const auto& [name, text] : rule.labels)
    parts.push_back(name + " = " + text);
  if (!names.empty()) parts.push_back("from the names " + join(names, ", "));
  if (!rule.experiment.empty()) parts.push_back("an experiment is " + rule.experiment);
  if (rule.delimiter || rule.decimal || rule.thousands || rule.skip_rows || rule.skip_footer ||
      rule.units_row || rule.header || rule.header_rows || !rule.segments.begins.empty() ||
      !rule.sheets.empty())
    parts.emplace_back("a dialect of its own");
  return fmt::format("{} ({} {}): {}", rule.match, files, files == 1 ? "file" : "files",
                     parts.empty() ? "nothing special" : join(parts, "; "));
}

// Possible labels of a file, from short to long: its name, with its folder, with all folders. A
// workbook is the folder of its sheets.
constexpr std::size_t label_forms = 3;

std::string label_of(const FilePlan& plan, std::size_t form) {
  const bool is_sheet = plan.name != plan.file;
  const fs::path path(plan.file),
      folder = is_sheet ? path.parent_path() / path.stem() : path.parent_path();
  const std::string own = is_sheet ? plan.options.sheets.front() : path.stem().string();
  const fs::path folders[label_forms] = {{}, folder.filename(), folder};
  return (folders[form] / own).generic_string();
}

// The shortest labels that are unique.
void set_labels(std::vector<FilePlan>& plans) {
  std::map<std::string, std::size_t> count[label_forms];
  for (const FilePlan& plan : plans)
    for (std::size_t form = 0; form < label_forms; ++form)
      ++count[form][label_of(plan, form)];
  for (FilePlan& plan : plans) {
    std::size_t form = 0;
    while (form + 1 < label_forms && count[form][label_of(plan, form)] > 1)
      ++form;
    plan.label = label_of(plan, form);
  }
}

} // namespace

std::vector<std::string> find_files(const std::vector<std::string>& named, const std::string& base,
                                    const Place& place) {
  std::vector<std::string> out;
  for (const std::string& name : named) {
    const fs::path path = inside(base, name);
    std::vector<std::string> found = {name};
    if (fs::is_directory(path))
      found = files_in(name, base);
    else if (name.find_first_of(glob_signs) != name.npos && !fs::exists(path))
      found = matching(name, base);
    if (found.empty())
      throw InputError(place, fmt::format("'{}' holds no file", name),
                       fs::is_directory(path)
                           ? "folders in it are not looked into: FOLDER/*/*.csv names their files"
                           : "names are relative to the job file; * stands for any letters but /");
    for (std::string& file : found)
      if (std::find(out.begin(), out.end(), file) == out.end()) out.push_back(std::move(file));
  }
  return out;
}

namespace {

bool is_absent(const fs::path& path) {
  std::error_code error;
  return fs::status(path, error).type() == fs::file_type::not_found;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (const std::string name = entry.path().filename().string(); !is_by_product(name))
      names.push_back(name);
  std::sort(names.begin(), names.end());
  return names;
}

// The name with its first part that is not there replaced by the nearest one in its folder.
std::string hint_for(const std::string& name, const std::string& base) {
  constexpr std::size_t most = 6;
  const fs::path here = base.empty() ? fs::path(".") : fs::path(base);
  const fs::path whole(name);
  fs::path found;
  fs::path::iterator part = whole.begin();
  for (; part != whole.end() && !is_absent(here / found / *part); ++part)
    found /= *part;
  if (part == whole.end()) return "";
  std::vector<std::string> names = names_in(here / found);
  const std::string near = nearest_name(part->string(), names);
  fs::path meant = found / near;
  for (++part; part != whole.end(); ++part)
    meant /= *part;
  if (!near.empty() && !is_absent(here / meant))
    return fmt::format("did you mean '{}'?", meant.string());
  const std::string folder = found.empty() ? "the folder of the job" : "'" + found.string() + "'";
  if (names.empty()) return folder + " holds no file";
  const std::size_t more = names.size() - std::min(names.size(), most);
  names.resize(names.size() - more);
  return fmt::format("{} holds {}{}", folder, join(names, ", "), and_more(more, "name"));
}

} // namespace

void check_is_there(const std::string& key, const std::string& name, const std::string& base,
                    const Place& place, FaultList& faults) {
  const bool in_job = place.line > 0;
  try {
    for (const std::string& file : find_files({name}, base, place))
      if (is_absent(inside(base, file)))
        faults.add(in_job ? place : Place{name, 0, 0},
                   in_job ? fmt::format("{}: no such file: '{}'", key, name)
                          : fmt::format("no such file ({})", key),
                   hint_for(name, base));
  } catch (const InputError& error) {
    faults.add(error);
  }
}

std::filesystem::path path_of(const FilePlan& plan) {
  return inside(plan.options.base, plan.file);
}

namespace {

// The options for a file, or a sheet of it, by its rule.
Reading options_of(const Reading& plain, std::size_t rule, const DataOptions& all) {
  Reading own = plain;
  if (rule < all.files.size()) apply(all.files[rule], own);
  return own;
}

// Adds a plan for each sheet of a workbook that is read. `rules`: of each plan.
void add_sheets(FilePlans& plans, const FilePlan& book, const Reading& plain,
                const DataOptions& all, std::vector<std::size_t>& rules) {
  const auto of_sheet = [&](const std::string& sheet) -> DataOptions {
    return options_of(plain, rule_of(book.file, all, sheet), all);
  };
  const SheetChoice choice =
      choose_sheets(path_of(book).string(), book.file, book.options, of_sheet);
  for (const std::string& sheet : choice.read) {
    rules.push_back(rule_of(book.file, all, sheet));
    plans.files.push_back(book);
    plans.files.back().options = options_of(plain, rules.back(), all);
    plans.files.back().options.sheets = {sheet};
    if (!choice.alone) plans.files.back().name = book.file + "/" + sheet;
  }
  if (!choice.passed.empty())
    plans.notes.push_back(fmt::format("{}: {} {} read, not read: {}", book.file, choice.read.size(),
                                      choice.read.size() == 1 ? "sheet" : "sheets",
                                      join(choice.passed, ", ")));
}

} // namespace

FilePlans plan_files(const std::vector<std::string>& files, const Reading& options) {
  FilePlans plans;
  Reading one = options; // for one file, without the lists of all files
  one.training.clear();
  one.validation.clear();
  one.files.clear();
  std::vector<std::size_t> rules; // of each plan
  for (const std::string& file : files) {
    const std::size_t rule = rule_of(file, options);
    FilePlan plan{file, file, "", options_of(one, rule, options)};
    if (io::looks_like_workbook(path_of(plan))) {
      add_sheets(plans, plan, one, options, rules);
      continue;
    }
    plans.files.push_back(std::move(plan));
    rules.push_back(rule);
  }
  set_labels(plans.files);
  for (std::size_t r = 0; r < options.files.size(); ++r) {
    std::vector<FilePlan*> own;
    for (std::size_t i = 0; i < plans.files.size(); ++i)
      if (rules[i] == r) own.push_back(&plans.files[i]);
    if (own.empty()) continue;
    std::vector<std::string> names;
    if (!options.files[r].from_name.empty()) names = FromNames(options.files[r], own).notes();
    plans.notes.push_back(note_of(options.files[r], own.size(), names));
  }
  return plans;
}

std::vector<std::string> names_of(const FilePlans& plans) {
  std::vector<std::string> names;
  for (const FilePlan& plan : plans.files)
    names.push_back(plan.name);
  return names;
}

void take_dialect_of_tests(DataOptions& options) {
  const FileRule* const rule = rule_of_tests(options);
  if (!rule) return;
  for (const auto* list : {&options.training, &options.validation}) {
    const std::vector<std::string> files = find_files(*list, options.base, options.place);
    if (std::find(files.begin(), files.end(), options.tests) != files.end()) return;
  }
  apply_dialect(*rule, options);
}

namespace {

struct SheetName {
  std::string file, sheet;
};

// All sheets of the workbooks among the files.
std::vector<SheetName> sheets_of(const std::vector<std::string>& files,
                                 const DataOptions& options) {
  std::vector<SheetName> all;
  for (const std::string& file : files)
    if (const fs::path path = inside(options.base, file); io::looks_like_workbook(path))
      for (const io::Workbook::Entry& one : io::Workbook(path, file).sheets())
        all.push_back({file, one.name});
  return all;
}

} // namespace

void check_rules(const std::vector<std::string>& files, const DataOptions& options) {
  FaultList faults;
  for (std::size_t r = 0; r < options.files.size(); ++r) {
    if (&options.files[r] == rule_of_tests(options)) continue;
    const auto is_its = [&](const std::string& file) { return rule_of(file, options) == r; };
    if (std::any_of(files.begin(), files.end(), is_its)) continue;
    const std::vector<SheetName> sheets = sheets_of(files, options);
    if (std::any_of(sheets.begin(), sheets.end(), [&](const SheetName& one) {
          return rule_of(one.file, options, one.sheet) == r;
        }))
      continue;
    const auto would = [&](const std::string& file) { return fits(options.files[r], file); };
    const bool late = std::any_of(files.begin(), files.end(), would) ||
                      std::any_of(sheets.begin(), sheets.end(), [&](const SheetName& one) {
                        return fits(options.files[r], one.file, one.sheet);
                      });
    std::vector<std::string> known = files;
    for (const SheetName& one : sheets)
      known.push_back(one.file + "/" + one.sheet);
    faults.add(options.files[r].place,
               fmt::format("no file is read by match = '{}'", options.files[r].match),
               late ? "an earlier rule matches all of them: the first one counts"
                    : "the files: " + join(known, ", "));
  }
  faults.throw_if_any();
}

} // namespace frictab::data
