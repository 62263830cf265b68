// frictab list [models|effects|targets|quantities|systems]: all registered names, one line each.
#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/print.h"
#include "codegen/exporter.h"
#include "core/error.h"
#include "core/text.h"
#include "core/wrapped.h"
#include "data/quantity.h"
#include "effects/effect.h"
#include "job/literature.h"
#include "job/systems.h"
#include "models/law.h"

namespace frictab::cli::list_command {

struct Line {
  std::string name;
  std::string title;
  bool by_name = false; // a job gets this law only by naming it
};

template <class T, class Items> std::vector<Line> lines_of(const Items& items) {
  std::vector<Line> lines;
  for (const T& item : items)
    lines.push_back({item.name, item.title});
  return lines;
}

std::vector<Line> quantity_lines() {
  std::vector<Line> lines;
  for (const data::Quantity& quantity : data::quantities())
    lines.push_back({quantity.name, fmt::format("{} [{}]", quantity.meaning, quantity.unit)});
  return lines;
}

const std::vector<std::string>& lists() {
  static const std::vector<std::string> names{"models", "effects", "targets", "quantities",
                                              "systems"};
  return names;
}

std::vector<Line> lines_of(const std::string& what) {
  if (what == "models" || what == "laws") {
    std::vector<Line> lines = lines_of<models::Law>(models::all_laws());
    for (const auto& law : job::literature().own())
      lines.push_back({law->name, law->title, true});
    return lines;
  }
  if (what == "effects") return lines_of<effects::EffectForm>(effects::all_effects());
  if (what == "targets") return lines_of<codegen::Exporter>(codegen::all_exporters());
  if (what == "quantities") return quantity_lines();
  if (what == "systems") return lines_of<job::System>(job::systems());
  throw InputError({}, fmt::format("there is no list of '{}'", what), suggest(what, lists()));
}

nlohmann::ordered_json json_of(const std::vector<Line>& lines) {
  auto list = nlohmann::ordered_json::array();
  for (const Line& line : lines) {
    list.push_back({{"name", line.name}, {"title", line.title}});
    if (line.by_name) list.back()["by_name"] = true;
  }
  return list;
}

void print(const std::vector<Line>& lines) {
  std::size_t width = 0;
  for (const Line& line : lines)
    width = std::max(width, line.name.size());
  bool by_name = false;
  for (const Line& line : lines) {
    if (line.by_name && !by_name)
      print_out("\nwhere models.use names them, as [\"all\", \"{}\"]:\n", line.name);
    by_name = line.by_name;
    print_out("{:<{}}  {}\n", line.name, width, wrapped(line.title, page_width, width + 2));
  }
}

int run(const std::string& what, const CommonOptions& common) {
  if (!what.empty()) {
    const std::vector<Line> lines = lines_of(what);
    common.json ? print_out("{}\n", json_of(lines).dump(2)) : print(lines);
    return 0;
  }
  nlohmann::ordered_json all;
  for (const std::string& name : lists()) {
    const std::vector<Line> lines = lines_of(name);
    all[name] = json_of(lines);
    if (common.json) continue;
    print_out("{}{} (frictab list {}):\n", name == lists().front() ? "" : "\n", name, name);
    print(lines);
  }
  if (common.json) print_out("{}\n", all.dump(2));
  return 0;
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  auto what = std::make_shared<std::string>();
  app.add_option("WHAT", *what, "models (or laws), effects, targets or quantities; all without it")
      ->type_name("{models,effects,targets,quantities}");
  return [what, &common] { return run(*what, common); };
}

const Registered<Command> registered{[] {
  return Command{"list",
                 80,
                 "List friction laws, effects, targets or quantities",
                 declare,
                 uses_json,
                 {{"frictab list", "everything"}, {"frictab list targets", "the FE codes"}}};
}};

} // namespace frictab::cli::list_command
