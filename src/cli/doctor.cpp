// frictab doctor: checks this machine for libraries, compilers and targets, with advice on missing
// ones.
#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/library_versions.h"
#include "cli/print.h"
#include "codegen/exporter.h"
#include "core/os/files.h"
#include "core/os/library.h"
#include "core/os/process.h"
#include "core/program.h"
#include "core/text.h"
#include "core/version.h"
#include "core/wrapped.h"
#include "models/law.h"

namespace frictab::cli::doctor_command {

using expr::Expr;

namespace fs = std::filesystem;

struct Finding {
  std::string topic; // "library", "compiler", "target", "machine"
  std::string name;
  bool ok = true;
  bool needed = true; // a failure where it is missing
  std::string text;
  std::string mend;
  bool in_text = true; // false: in JSON alone
};

struct Compiler {
  const char* name;
  const char* package;
  bool needed;
  const char* purpose;
};

constexpr Compiler compilers[] = {
    {"gcc", "gcc", true, "compiles the generated C for verify"},
    {"gfortran", "gfortran", true, "compiles the generated Fortran for verify"},
    {"clang", "clang", false, "a second opinion on the generated C"},
    {"luajit", "luajit", false, "runs the generated Lua for verify, as QForm does"},
    {"lua5.4", "lua5.4", false, "a second opinion on the generated Lua"},
};

std::string package_of(const std::string& program) {
  for (const Compiler& compiler : compilers)
    if (program == compiler.name) return compiler.package;
  return program == "cc" ? "gcc" : program;
}

void add_libraries(std::vector<Finding>& out) {
  out.push_back({"library", "frictab", true, true, tool_version(), ""});
  std::vector<std::string> versions;
  for (const auto& [name, version] : library_versions()) {
    out.push_back({"library", name, true, true, version, "", false});
    versions.push_back(name + " " + version);
  }
  const std::vector<os::LoadedLibrary> loaded = os::loaded_libraries();
  for (const os::LoadedLibrary& library : loaded)
    out.push_back({"library", library.name, true, true, library.file.string(), "", false});
  out.push_back({"library", "libraries", true, true,
                 fmt::format("{} shared ones are loaded (--json lists them); {}", loaded.size(),
                             join(versions, ", ")),
                 ""});
}

void add_compilers(std::vector<Finding>& out) {
  for (const Compiler& compiler : compilers) {
    const std::string file = os::on_path(compiler.name);
    out.push_back({"compiler", compiler.name, !file.empty(), compiler.needed,
                   file.empty() ? std::string("not found; ") + compiler.purpose : file,
                   file.empty() ? std::string("apt install ") + compiler.package : ""});
  }
}

// Returns the smallest table with which a target can give its compile command.
table::Table probe_table() {
  table::Table table;
  table.model = "coulomb";
  table.value = {0.1};
  table.combine =
      models::limited(Expr::symbol("value") * Expr::symbol("sigma_n_MPa"), models::Conventions{});
  return table;
}

Finding target_finding(const codegen::Exporter& target) {
  Finding finding{"target", target.name, true, false, "verify can run it", ""};
  const table::Table table = probe_table();
  try {
    const auto variants = target.variants(codegen::ExportRequest{table, "mm-t-s", {}});
    if (variants.empty()) {
      finding.text = "written, but verify has no way to run it here";
      return finding;
    }
    std::vector<std::string> lacking;
    for (const codegen::BuildVariant& variant : variants) {
      const std::string& program = variant.program();
      const bool there =
          program.empty() || (program.find('/') == program.npos && !os::on_path(program).empty());
      if (!there && std::ranges::count(lacking, program) == 0) lacking.push_back(program);
    }
    if (lacking.empty()) return finding;
    finding.ok = false;
    finding.text = "verify cannot run it: needs " + join(lacking, ", ");
    finding.mend = "apt install " + package_of(lacking.front());
  } catch (const std::exception& error) {
    finding.text = fmt::format("not known: {}", error.what());
  }
  return finding;
}

Finding temporary_finding() {
  const fs::path directory = temporary_place();
  std::error_code error;
  const bool ok =
      fs::is_directory(directory, error) && os::may_write(directory) && os::may_run(directory);
  return {"machine",
          "temporary directory",
          ok,
          true,
          ok ? "can be written" : "cannot be written: verify compiles there",
          ok ? "" : "set TMPDIR to a directory that can be written"};
}

std::vector<Finding> examine() {
  std::vector<Finding> out;
  add_libraries(out);
  add_compilers(out);
  for (const codegen::Exporter& target : codegen::all_exporters())
    out.push_back(target_finding(target));
  out.push_back({"machine", "threads", true, true,
                 std::to_string(std::max(1u, std::thread::hardware_concurrency())), ""});
  out.push_back(temporary_finding());
  return out;
}

const char* mark_of(const Finding& finding) {
  if (finding.ok) return "ok";
  return finding.needed ? "MISSING" : "absent";
}

void print_text(const std::vector<Finding>& findings) {
  std::size_t width = 0;
  for (const Finding& finding : findings)
    if (finding.in_text) width = std::max(width, finding.name.size());
  const std::size_t indent = 2 + 7 + 2 + width + 2;
  std::string topic;
  for (const Finding& finding : findings) {
    if (!finding.in_text) continue;
    if (finding.topic != topic) print_out("{}{}\n", topic.empty() ? "" : "\n", finding.topic);
    topic = finding.topic;
    print_out("  {:<7}  {:<{}}  {}\n", mark_of(finding), finding.name, width,
              wrapped(finding.text, page_width, indent));
    if (!finding.mend.empty())
      print_out("  {:<7}  {:<{}}  mend: {}\n", "", "", width, finding.mend);
  }
}

void print_json(const std::vector<Finding>& findings) {
  auto list = nlohmann::ordered_json::array();
  for (const Finding& f : findings)
    list.push_back({{"topic", f.topic},
                    {"name", f.name},
                    {"ok", f.ok},
                    {"needed", f.needed},
                    {"text", f.text},
                    {"mend", f.mend}});
  print_out("{}\n", list.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

int run(const CommonOptions& common) {
  const std::vector<Finding> findings = examine();
  common.json ? print_json(findings) : print_text(findings);
  std::vector<std::string> missing;
  for (const Finding& finding : findings)
    if (!finding.ok && finding.needed) missing.push_back(finding.name + " (" + finding.mend + ")");
  std::fflush(stdout);
  if (!missing.empty()) throw std::runtime_error("missing: " + join(missing, ", "));
  return 0;
}

std::function<int()> declare(CLI::App&, const CommonOptions& common) {
  return [&common] { return run(common); };
}

const Registered<Command> registered{[] {
  return Command{
      "doctor", 90,        "Say what this machine has for the job, and what is missing",
      declare,  uses_json, {{"frictab doctor", "compilers, libraries, what verify can run here"}}};
}};

} // namespace frictab::cli::doctor_command
