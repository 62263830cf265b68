// Writes a job file that explains itself, from the schema.
#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "job/schema.h"

namespace frictab::job {

namespace {

// Adds prose as comment lines of readable length.
void add_prose(std::string& out, const std::string& text) {
  constexpr std::size_t width = 88;
  std::istringstream words(text);
  std::string line = "#", word;
  while (words >> word) {
    if (line.size() + 1 + word.size() > width) {
      out += line + "\n";
      line = "#";
    }
    line += " " + word;
  }
  out += line + "\n";
}

// Adds keys to be uncommented: their '#' is not followed by a blank.
void add_commented(std::string& out, const std::string& lines) {
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);)
    out += "#" + line + "\n";
}

void add_key(std::string& out, const KeyRule& rule) {
  const std::string normal = default_text(rule);
  add_prose(out, rule.absent.empty() ? rule.meaning : rule.meaning + "; absent: " + rule.absent);
  const bool required = rule.path == "data.training";
  out += fmt::format("{}{} = {}\n", required ? "" : "#", last_part(rule.path),
                     normal.empty() ? rule.example : normal);
}

// Lists the keys below a name that the user chooses, as prose.
void add_named_keys(std::string& out, const std::string& section) {
  for (const KeyRule& rule : key_rules()) {
    if (rule.path == section + ".*") add_prose(out, rule.meaning);
    if (parent_of(rule.path) == section + ".*")
      add_prose(out,
                fmt::format("{}: {}; absent: {}", last_part(rule.path), rule.meaning, rule.absent));
  }
}

// Adds a section that the user names, in addition to keys of fixed names: [models.my_law].
void add_own_section(std::string& out, const SectionRule& section) {
  const SectionRule* each = find_section(section.path + ".*");
  if (!section.others || !each) return;
  out += "\n";
  add_prose(out, each->meaning);
  for (const KeyRule& rule : key_rules()) {
    if (!rule.path.starts_with(each->path + ".")) continue;
    const std::string within = rule.path.substr(each->path.size() + 1);
    const bool named = within.ends_with(".*"), deeper = within.find('.') != within.npos;
    const std::string key = named ? within.substr(0, within.size() - 2) : last_part(rule.path);
    add_prose(out,
              fmt::format("{}: {}{}; absent: {}", key,
                          deeper && !named ? "in " + within.substr(0, within.find('.')) + ": " : "",
                          rule.meaning, rule.absent));
  }
  add_commented(out, fmt::format("[{}.my_law]\n{}", section.path, each->example));
}

bool has_keys(const std::string& section) {
  return std::ranges::any_of(key_rules(), [&](const KeyRule& rule) {
    return parent_of(rule.path) == section && last_part(rule.path) != "*";
  });
}

void add_named_section(std::string& out, const SectionRule& section) {
  out += "\n";
  add_prose(out, section.meaning);
  add_named_keys(out, section.path);
  const SectionRule* each = find_section(section.path + ".*");
  if (section.path == "data.drop") { // a key of [data], as the contract writes it
    add_commented(out, section.example);
  } else if (each && !each->example.empty()) {
    add_commented(out, fmt::format("[{}.v_rel_mm_s]\n{}", section.path, each->example));
  } else {
    add_commented(out, fmt::format("[{}]\n{}", section.path, section.example));
  }
}

} // namespace

std::string job_template() {
  std::string out =
      "# A frictab job. Lines that start with # and no blank are keys with their defaults\n# (or "
      "an example): remove the # to change one. `frictab explain KEY` says more.\n";
  for (const SectionRule& section : section_rules()) {
    if (section.path.find('*') != std::string::npos) continue;
    if (section.list) {
      out += "\n";
      add_prose(out, section.meaning);
      add_named_keys(out, section.path);
      add_commented(out, fmt::format("[[{}]]\n{}", section.path, section.example));
      continue;
    }
    if (section.children && !has_keys(section.path)) {
      add_named_section(out, section);
      continue;
    }
    out += fmt::format("\n[{}]", section.path);
    out += "  # " + section.meaning + "\n";
    for (const KeyRule& rule : key_rules())
      if (parent_of(rule.path) == section.path) add_key(out, rule);
    add_own_section(out, section);
  }
  return out;
}

} // namespace frictab::job
