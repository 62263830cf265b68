// Reads a job file: TOML, then every key by the schema, then the checks across keys.
#include <algorithm>
#include <filesystem>
#include <tuple>

#include <fmt/format.h>

#include "core/text.h"
#include "data/file_list.h"
#include "data/quantity.h"
#include "expr/expr.h"
#include "io/file_streams.h"
#include "io/text_file.h"
#include "job/literature.h"
#include "job/reader.h"

namespace frictab::job {

namespace {

std::string below(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

// Finds the section of a misplaced key: "table.tolerance_MPa" for tolerance_MPa in [data].
std::string home_of(const std::string& key) {
  for (const KeyRule& rule : key_rules())
    if (rule.path.find('*') == rule.path.npos && last_part(rule.path) == key) return rule.path;
  return "";
}

void unknown_key(JobReader& reader, const std::string& rule_path, const std::string& path,
                 const TomlNode& entry) {
  const std::string where = path.empty() ? "at the top of the file" : "in [" + path + "]";
  std::vector<std::string> known = fixed_names(rule_path);
  if (const SectionRule* here = find_section(rule_path); here && here->children)
    for (const std::string& name : here->children())
      known.push_back(name);
  std::string hint = suggest(entry.key, known);
  const std::string home = home_of(entry.key);
  if (nearest_name(entry.key, known).empty() && !home.empty())
    hint =
        fmt::format("did you mean '{}'? It stands in [{}]", home, home.substr(0, home.find('.')));
  reader.fault(entry.key_place, fmt::format("unknown key {} {}", in_quotes(entry.key), where),
               hint);
}

bool known_name(JobReader& reader, const SectionRule& section, const std::string& path,
                const TomlNode& entry) {
  const auto names = section.children();
  if (std::ranges::find(names, entry.key) != names.end()) return true;
  if (section.others && (section.any_name || expr::is_name(entry.key)) &&
      !data::is_measured(entry.key))
    return true;
  if (data::find_quantity(entry.key))
    reader.fault(entry.key_place, fmt::format("{} cannot stand in [{}]", entry.key, path),
                 "possible: " + join(names, ", "));
  else if (section.others && names.empty() && !expr::is_name(entry.key))
    reader.fault(entry.key_place,
                 fmt::format("{} in [{}] cannot be the name of a {}", in_quotes(entry.key), path,
                             section.child),
                 "names have letters from a to z, digits and _, and begin with a letter: they "
                 "stand in formulas, files and routines");
  else
    reader.fault(entry.key_place,
                 fmt::format("unknown {} {} in [{}]", section.child, in_quotes(entry.key), path),
                 suggest(entry.key, names));
  return false;
}

// Whether an entry of this section has a name that the user chooses. In a section that also has
// fixed names, such an entry is one of the known names, or a table where other names are allowed.
bool is_by_name(const SectionRule* section, const std::string& rule_path, const TomlNode& entry) {
  if (!section || !section->children) return false;
  const std::vector<std::string> fixed = fixed_names(rule_path), names = section->children();
  if (fixed.empty() || std::ranges::find(names, entry.key) != names.end()) return true;
  return section->others && entry.type == TomlNode::Type::table &&
         std::ranges::find(fixed, entry.key) == fixed.end();
}

void walk(JobReader& reader, const TomlNode& table, const std::string& rule_path,
          const std::string& path, const std::string& name);

// Walks each table of [[data.files]].
void walk_list(JobReader& reader, const TomlNode& list, const std::string& rule_path,
               const std::string& path) {
  const auto is_table = [](const TomlNode& item) { return item.type == TomlNode::Type::table; };
  if (list.type != TomlNode::Type::array || !std::ranges::all_of(list.items, is_table)) {
    reader.fault(list.place,
                 fmt::format("{} must be a list of tables, not {}", path, describe(list)),
                 fmt::format("write [[{}]]", path));
    return;
  }
  for (std::size_t i = 0; i < list.items.size(); ++i)
    walk(reader, list.items[i], rule_path + ".*", fmt::format("{}[{}]", path, i + 1),
         std::to_string(i + 1));
}

// `rule_path` has '*' where `path` has a name; `name` is those names, with dots between them.
void walk(JobReader& reader, const TomlNode& table, const std::string& rule_path,
          const std::string& path, const std::string& name) {
  const SectionRule* here = find_section(rule_path);
  if (here && here->place) *here->place(reader.job, name) = table.place;
  reader.places[path] = table.place;
  for (const TomlNode& entry : table.items) {
    const bool by_name = is_by_name(here, rule_path, entry);
    if (!by_name && entry.key.find('.') != entry.key.npos) { // "data.training" in quotes
      unknown_key(reader, rule_path, path, entry);
      continue;
    }
    if (by_name && !known_name(reader, *here, path, entry)) continue;
    const std::string rule_below = below(rule_path, by_name ? "*" : entry.key);
    const std::string path_below = below(path, entry.key);
    const std::string name_below = by_name ? below(name, entry.key) : name;
    if (const SectionRule* section = find_section(rule_below)) {
      if (section->list) {
        walk_list(reader, entry, rule_below, path_below);
      } else if (entry.type == TomlNode::Type::table) {
        walk(reader, entry, rule_below, path_below, name_below);
      } else if (!section->plain.empty()) { // tau_R_MPa = "Friction"
        *section->place(reader.job, name_below) = entry.place;
        read_value(reader, *find_key(rule_below + "." + section->plain), path_below, name_below,
                   entry);
      } else {
        if (path_below == "data") reader.data_is_no_table = true;
        reader.fault(entry.place,
                     fmt::format("{} must be a table, not {}", path_below, describe(entry)),
                     by_name ? "write " + entry.key + " = { ... }" : "write [" + path_below + "]");
      }
    } else if (const KeyRule* rule = find_key(rule_below, reader.of_program)) {
      read_value(reader, *rule, path_below, name_below, entry);
    } else {
      unknown_key(reader, rule_path, path, entry);
    }
  }
}

constexpr std::uint64_t largest_law_file = 1 << 20;

// A law also has a formula or a table's name.
bool holds_only_tables(const TomlNode& node) {
  return std::ranges::all_of(
      node.items, [](const TomlNode& item) { return item.type == TomlNode::Type::table; });
}

// Reads the files of models.files, each a table of laws.
std::vector<TomlNode> read_law_files(JobReader& reader, TomlNode& root) {
  std::vector<TomlNode> files;
  TomlNode* const models = root.find("models");
  TomlNode* const named = models ? models->find("files") : nullptr;
  if (!named) return files;
  JobReader only; // faults of the key itself are reported with the others
  only.job.file = reader.job.file;
  read_value(only, *find_key("models.files"), "models.files", "", *named);
  const std::string base = std::filesystem::path(reader.job.file).parent_path().string();
  FaultList missing;
  for (const std::string& name : only.job.models.files)
    data::check_is_there("models.files", name, base,
                         only.job.file_places.at({"models.files", name}), missing);
  try {
    missing.throw_if_any();
    for (const std::string& name : data::find_files(only.job.models.files, base, named->place)) {
      const std::string path = (std::filesystem::path(base) / name).string();
      TomlNode laws = parse_toml(io::read_text_file(path, path, {.bytes = largest_law_file}), path);
      if (const TomlNode* below = laws.find("models"); below && holds_only_tables(*below)) {
        reader.fault(below->key_place, "a file of models.files has its laws at the top",
                     "[mine] and [mine.parameters], not [models.mine]");
        std::erase_if(laws.items, [](const TomlNode& item) { return item.key == "models"; });
      }
      files.push_back(std::move(laws));
    }
  } catch (const InputError& error) {
    reader.faults.insert(reader.faults.end(), error.faults().begin(), error.faults().end());
  }
  return files;
}

// Registers the names of laws, to which keys elsewhere may refer before the laws are read.
void note_laws(JobReader& reader, const TomlNode& tables) {
  for (const TomlNode& entry : tables.items)
    if (entry.type == TomlNode::Type::table) reader.own_laws.push_back(entry.key);
}

// Adds laws of the literature that models.use names, also together with "all".
void add_literature(JobReader& reader) {
  models::Laws& laws = reader.job.models.laws;
  std::vector<std::string>& use = reader.job.models.use;
  for (const std::string& name : use)
    if (!laws.find(name))
      if (const models::Law* law = literature().find(name)) {
        laws.add(*law);
        reader.job.sections["models"] += literature_text(name);
      }
  const bool all = std::ranges::count(use, "all") > 0;
  if (all)
    std::erase_if(use, [](const std::string& name) { return !literature_text(name).empty(); });
  if (use == std::vector<std::string>{"all"}) use.clear();
}

void sort_by_place(std::vector<Fault>& faults) {
  std::ranges::stable_sort(faults, [](const Fault& a, const Fault& b) {
    const auto rank = [](const Fault& f) {
      const bool set = f.place.file.starts_with("--set"); // --set 9 before --set 10
      return std::tuple(set ? f.place.file.size() : 0, set ? f.place.file : "", f.place.line,
                        f.place.column);
    };
    return rank(a) < rank(b);
  });
}

void resolve_paths(Job& job) {
  namespace fs = std::filesystem;
  const fs::path base = fs::path(job.file).parent_path();
  job.data.base = base.string();
  job.process.base = base.string();
  job.directory = (base / job.directory).lexically_normal().string();
}

} // namespace

void read_laws(JobReader& reader, const TomlNode& file) {
  for (const TomlNode& entry : file.items)
    if (entry.type == TomlNode::Type::table)
      walk(reader, entry, "models.*", "models." + entry.key, entry.key);
    else
      reader.fault(entry.key_place, fmt::format("{} is not a law", in_quotes(entry.key)),
                   "a file of laws holds a table per law: [my_law]");
}

Place JobReader::place_of(std::string path) const {
  while (true) {
    const auto found = places.find(path);
    if (found != places.end() && !found->second.file.empty()) return found->second;
    const std::size_t dot = path.rfind('.');
    if (dot == path.npos) return {job.file, 0, 0};
    path.resize(dot);
  }
}

Job parse_job(std::string_view text, const std::string& file, const std::vector<std::string>& set) {
  if (text.find_first_not_of(" \t\r\n") == text.npos)
    throw InputError({file, 0, 0}, "the job file is empty",
                     "`frictab init DIR` writes one with every key explained");
  TomlNode root = parse_toml(text, file);
  JobReader reader;
  for (std::size_t i = 0; i < set.size(); ++i) {
    try {
      apply_override(root, set[i], i + 1);
    } catch (const InputError& error) {
      reader.faults.insert(reader.faults.end(), error.faults().begin(), error.faults().end());
    }
  }
  reader.job.file = file;
  const Place whole{file, 0, 0};
  for (Place* place : {&reader.job.data.place, &reader.job.models.place, &reader.job.table.place,
                       &reader.job.exports.place})
    *place = whole;
  const std::vector<TomlNode> law_files = read_law_files(reader, root);
  if (const TomlNode* models = root.find("models")) note_laws(reader, *models);
  for (const TomlNode& laws : law_files)
    note_laws(reader, laws);
  walk(reader, root, "", "", "");
  for (TomlNode section : root.items) {
    if (section.key == "table")
      std::erase_if(section.items, [](const TomlNode& item) { return item.key == "model"; });
    reader.job.sections[section.key] = canonical_text(section);
  }
  for (const TomlNode& laws : law_files) {
    read_laws(reader, laws);
    reader.job.sections["models"] += canonical_text(laws);
  }
  make_laws(reader);
  add_literature(reader);
  check_job(reader);
  sort_by_place(reader.faults);
  if (!reader.faults.empty()) throw InputError(std::move(reader.faults));
  resolve_paths(reader.job);
  return std::move(reader.job);
}

Job read_job(const std::string& file, const std::vector<std::string>& set) {
  return parse_job(io::read_file(file), file, set);
}

} // namespace frictab::job
