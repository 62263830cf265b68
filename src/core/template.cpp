// The strict renderer: checks that template and values fit each other exactly, then writes.
#include "core/template.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/template_tree.h"
#include "core/text.h"

namespace frictab {

extern const std::pair<std::string_view, std::string_view> embedded_files[];
extern const unsigned embedded_count;

namespace {

using Kind = TemplateNode::Kind;

// A loop variable and its item; without item the list is empty and only syntax can be checked.
struct Scope {
  std::string variable; // empty: the values as a whole
  const TemplateValues* values;
};

template <class Map>
const typename Map::mapped_type* look_up(const Map& map, const std::string& k) {
  const auto found = map.find(k);
  return found == map.end() ? nullptr : &found->second;
}

std::vector<std::string> names_of(const TemplateValues& values) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values.text)
    names.push_back(name);
  for (const auto& [name, value] : values.flags)
    names.push_back(name);
  for (const auto& [name, value] : values.lists)
    names.push_back(name);
  return names;
}

// Walks every branch and finds unknown names, names of another kind in branches that are taken, and
// values that no branch names.
class Checker {
public:
  Checker(std::string_view file, FaultList& faults) : file_(file), faults_(faults) {}

  void check(const std::vector<TemplateNode>& tree, const TemplateValues& values) {
    scopes_.push_back({"", &values});
    walk(tree);
    report_unused(values, {file_, 1, 1});
    for (const auto& [item, place] : items_)
      report_unused(*item, place);
  }

private:
  void walk(const std::vector<TemplateNode>& nodes) {
    for (const TemplateNode& node : nodes) {
      if (node.kind == Kind::insert) {
        use(node.name, "text", &TemplateValues::text);
      } else if (node.kind == Kind::choice) {
        const bool* flag = use(node.name, "flag", &TemplateValues::flags);
        walk_branch(node.body, flag && *flag);
        walk_branch(node.otherwise, flag && !*flag);
      } else if (node.kind == Kind::loop) {
        walk_loop(node);
      }
    }
  }

  void walk_branch(const std::vector<TemplateNode>& nodes, bool taken) {
    const bool before = taken_;
    taken_ = taken_ && taken;
    walk(nodes);
    taken_ = before;
  }

  void walk_loop(const TemplateNode& node) {
    for (const Scope& scope : scopes_)
      if (scope.variable == node.variable)
        return faults_.add(node.name.place, "'" + node.variable + "' is already a loop variable");
    const auto* list = use(node.name, "list", &TemplateValues::lists);
    if (!list || list->empty()) {
      scopes_.push_back({node.variable, nullptr});
      walk_branch(node.body, false);
      scopes_.pop_back();
      return;
    }
    for (const TemplateValues& item : *list) {
      const std::size_t before = faults_.size();
      scopes_.push_back({node.variable, &item});
      walk(node.body);
      scopes_.pop_back();
      if (seen_.insert(&item).second) items_.emplace_back(&item, node.name.place);
      if (faults_.size() != before) break; // the next item has the same faults
    }
  }

  template <class Map>
  const typename Map::mapped_type* use(const TemplateName& name, const char* kind,
                                       Map TemplateValues::*member) {
    for (const Scope& scope : scopes_) {
      if (scope.variable != name.scope) continue;
      if (!scope.values) return nullptr;
      used_.insert({scope.values, name.name});
      const auto* found = look_up(scope.values->*member, name.name);
      if (!found && taken_)
        faults_.add(name.place, "there is no " + std::string(kind) + " '" + name.text() + "'",
                    suggest(name.name, names_of(*scope.values)));
      return found;
    }
    faults_.add(name.place, "'" + name.scope + "' is not a loop variable here");
    return nullptr;
  }

  void report_unused(const TemplateValues& values, const Place& place) {
    for (const std::string& name : names_of(values))
      if (!used_.count({&values, name}) && !values.offered.count(name) &&
          reported_.insert({place.line, place.column, name}).second)
        faults_.add(place, "the value '" + name + "' is never used");
  }

  std::string file_;
  FaultList& faults_;
  std::vector<Scope> scopes_;
  bool taken_ = true; // the branch being walked will be written
  std::set<std::pair<const TemplateValues*, std::string>> used_;
  // Values in list items that no loop used; reported at the end, because several loops may walk one
  // list.
  std::vector<std::pair<const TemplateValues*, Place>> items_;
  std::set<const TemplateValues*> seen_;
  std::set<std::tuple<std::size_t, std::size_t, std::string>> reported_;
};

// Writes the tree with values that were checked before, so that every look-up succeeds.
class Writer {
public:
  std::string out;

  void write(const std::vector<TemplateNode>& nodes, std::vector<Scope>& scopes) {
    for (const TemplateNode& node : nodes) {
      switch (node.kind) {
      case Kind::text:
        out += node.text;
        break;
      case Kind::insert:
        insert(values(node.name, scopes).text.at(node.name.name), node);
        break;
      case Kind::choice:
        write(values(node.name, scopes).flags.at(node.name.name) ? node.body : node.otherwise,
              scopes);
        break;
      case Kind::loop:
        for (const TemplateValues& item : values(node.name, scopes).lists.at(node.name.name)) {
          scopes.push_back({node.variable, &item});
          write(node.body, scopes);
          scopes.pop_back();
        }
      }
    }
  }

private:
  static const TemplateValues& values(const TemplateName& name, const std::vector<Scope>& scopes) {
    for (const Scope& scope : scopes)
      if (scope.variable == name.scope) return *scope.values;
    throw std::logic_error("template name was not checked");
  }

  void insert(const std::string& text, const TemplateNode& node) {
    const std::string& blanks = node.text;
    if (node.whole_line && text.empty()) return;
    if (node.whole_line) out += blanks;
    for (std::size_t i = 0; i < text.size(); ++i) {
      out += text[i];
      if (text[i] == '\n' && i + 1 < text.size() && text[i + 1] != '\n') out += blanks;
    }
    if (node.whole_line) out += '\n';
  }
};

std::string written(const std::vector<TemplateNode>& tree, const TemplateValues& values) {
  Writer writer;
  std::vector<Scope> scopes{{"", &values}};
  writer.write(tree, scopes);
  return writer.out;
}

} // namespace

std::string render(std::string_view text, std::string_view file, const TemplateValues& values) try {
  FaultList faults;
  const std::vector<TemplateNode> tree = parse_template(text, file, faults);
  faults.throw_if_any();
  Checker(file, faults).check(tree, values);
  faults.throw_if_any();
  return written(tree, values);
} catch (const InputError& error) {
  throw std::logic_error(error.what());
}

std::string insert_names(std::string_view line, const std::map<std::string, std::string>& names) {
  TemplateValues values;
  for (const auto& [name, text] : names)
    if (line.find("@{" + name + "}") != std::string_view::npos) values.text[name] = text;
  return render(line, line, values);
}

std::string_view embedded_template(std::string_view path) {
  for (unsigned i = 0; i < embedded_count; ++i)
    if (embedded_files[i].first == path) return embedded_files[i].second;
  throw std::logic_error("no template '" + std::string(path) + "' in this program");
}

std::vector<std::string_view> embedded_paths(std::string_view folder) {
  std::vector<std::string_view> paths; // sorted by the build
  for (unsigned i = 0; i < embedded_count; ++i)
    if (embedded_files[i].first.starts_with(folder)) paths.push_back(embedded_files[i].first);
  return paths;
}

namespace {

// Puts the lines of other templates in place of "@include path".
std::string with_includes(std::string_view text) {
  constexpr std::string_view directive = "@include ";
  std::string out;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, std::min(text.find('\n'), text.size() - 1) + 1);
    if (line.starts_with(directive))
      out += with_includes(embedded_template(trimmed(line.substr(directive.size()))));
    else
      out += line;
    text.remove_prefix(line.size());
  }
  return out;
}

} // namespace

std::string render_template(std::string_view path, const TemplateValues& values) {
  return render(with_includes(embedded_template(path)), "templates/" + std::string(path), values);
}

std::string render_part(std::string_view path, const TemplateValues& values) {
  return without_last_break(render_template(path, values));
}

std::string without_last_break(std::string text) {
  if (text.ends_with('\n')) text.pop_back();
  return text;
}

TemplateValues item(std::string text) {
  TemplateValues values;
  values.text["text"] = std::move(text);
  return values;
}

Lines items(const std::vector<std::string>& texts) {
  Lines lines;
  for (const std::string& text : texts)
    lines.push_back(item(text));
  return lines;
}

} // namespace frictab
