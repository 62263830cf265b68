// Mutants of generated routines: each line changed in turn (operators, indices, constants, a
// statement deleted), compiled and driven over increments as `frictab verify` does. Counts those
// whose answers differ from the routine's own and that pass all the same.
//
// Arguments: --part K/N takes every N-th mutant from the K-th on; --target NAME one target alone;
// --survivors lists those that pass.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "codegen/compile.h"
#include "core/program.h"
#include "core/text.h"
#include "support/sample_tables.h"

namespace frictab::bench {

namespace {

using codegen::BuildVariant;
using codegen::Exporter;
using codegen::ExportRequest;
using codegen::SourceBundle;

struct Mutant {
  std::string file;
  std::size_t line = 0; // from 0
  std::string text;     // of the line, changed; empty: deleted
  std::string kind;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  return lines;
}

std::string stripped(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(' ');
  return begin == std::string::npos ? ""
                                    : line.substr(begin, line.find_last_not_of(' ') + 1 - begin);
}

// Replaces `from` at every place where it stands alone, one place at a time.
void add_replaced(std::vector<Mutant>& out, const Mutant& at, const std::string& line,
                  const std::string& from, const std::string& to, const char* kind) {
  for (std::size_t i = 6; (i = line.find(from, i)) != std::string::npos; i += from.size()) {
    Mutant one = at;
    one.text = line.substr(0, i) + to + line.substr(i + from.size());
    one.kind = kind;
    out.push_back(one);
  }
}

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

// Each number of the line: an integer one more, any other a hundredth more, or 1 for 0.
void add_numbers(std::vector<Mutant>& out, const Mutant& at, const std::string& line) {
  for (std::size_t i = 6; i < line.size(); ++i) {
    if (!std::isdigit(static_cast<unsigned char>(line[i])) || is_word(line[i - 1]) ||
        line[i - 1] == '.')
      continue;
    std::size_t end = i;
    while (end < line.size() && (is_word(line[end]) || line[end] == '.') &&
           !(line[end] == '.' && end + 1 < line.size() &&
             std::isalpha(static_cast<unsigned char>(line[end + 1])) &&
             std::toupper(line[end + 1]) != 'D' && std::toupper(line[end + 1]) != 'E'))
      ++end;
    std::string number = line.substr(i, end - i);
    Mutant one = at;
    if (number.find_first_not_of("0123456789") == std::string::npos) {
      one.kind = "index";
      number = std::to_string(std::stoull(number) + 1);
    } else if (number.find('.') != std::string::npos) {
      one.kind = "constant";
      const double value = std::atof(replace_all(replace_all(number, "D", "e"), "d", "e").c_str());
      number = value == 0 ? "1.0D0" : "(" + number + "*1.01D0)";
    } else {
      i = end;
      continue;
    }
    one.text = line.substr(0, i) + number + line.substr(end);
    out.push_back(one);
    i = end;
  }
}

const std::vector<std::pair<std::string, std::string>> comparisons = {
    {".lt.", ".ge."},     {".ge.", ".lt."}, {".gt.", ".le."},  {".le.", ".gt."},
    {".eq.", ".ne."},     {".ne.", ".eq."}, {".and.", ".or."}, {".or.", ".and."},
    {".not. ", ""},       {"max(", "min("}, {"min(", "max("},  {".true.", ".false."},
    {".false.", ".true."}};
const std::vector<std::pair<std::string, std::string>> operators = {
    {" + ", " - "}, {" - ", " + "}, {"*", "/"}, {"/", "*"}};

// A declaration, or what only shapes the program: not a statement that computes.
bool declares(const std::string& code) {
  for (const char* word : {"subroutine", "end",        "double precision",
                           "integer",    "logical",    "external",
                           "implicit",   "include",    "dimension",
                           "character",  "parameter",  "common",
                           "save",       "return",     "else",
                           "data ",      "block data", "real ",
                           "function",   "do ",        "pure",
                           "interface",  "module",     "use ",
                           "!",          "entry",      "double"})
    if (code.starts_with(word)) return true;
  return code.find(" function ") != std::string::npos || code.empty();
}

// The names of program units that were seen with the same text; what targets share is changed once.
std::vector<Mutant> mutants_of(const std::string& file, const std::string& text,
                               std::set<std::string>& seen_units) {
  const std::vector<std::string> lines = lines_of(text);
  std::vector<Mutant> out;
  std::size_t begin = 0;
  for (std::size_t end = 0; end < lines.size(); ++end) {
    if (stripped(lines[end]) != "end" && stripped(lines[end]).rfind("end subroutine", 0) != 0)
      continue;
    std::string unit;
    for (std::size_t i = begin; i <= end; ++i)
      if (!lines[i].starts_with('C')) unit += lines[i] + "\n";
    const bool is_new = seen_units.insert(unit).second;
    for (std::size_t i = begin; is_new && i <= end; ++i) {
      const std::string& line = lines[i];
      if (line.size() < 7 || line[0] == 'C' || line[0] == '!') continue;
      const bool continued = line[5] != ' ';
      const std::string code = stripped(line.substr(6));
      const bool is_data = code.starts_with("data ") || code.starts_with("parameter");
      if (declares(code) && !is_data && !continued && !code.starts_with("else if") &&
          !code.starts_with("do "))
        continue;
      const Mutant at = {file, i, "", ""};
      for (const auto& [from, to] : comparisons)
        add_replaced(out, at, line, from, to, "comparison");
      for (const auto& [from, to] : operators)
        add_replaced(out, at, line, from, to, "operator");
      add_numbers(out, at, line);
      const bool goes_on = i + 1 < lines.size() && lines[i + 1].size() > 5 &&
                           lines[i + 1][0] != 'C' && lines[i + 1][5] != ' ';
      const bool assigns = code.find('=') != std::string::npos || code.starts_with("call ");
      if (assigns && !continued && !goes_on && !declares(code) && !code.starts_with("if (") &&
          code.find(") then") == std::string::npos)
        out.push_back({file, i, "", "deleted"});
    }
    begin = end + 1;
  }
  return out;
}

SourceBundle mutated(SourceBundle bundle, const Mutant& mutant) {
  std::vector<std::string> lines = lines_of(bundle.at(mutant.file));
  lines[mutant.line] = mutant.text.empty() ? "C" : mutant.text;
  bundle[mutant.file] = join(lines, "\n") + "\n";
  return bundle;
}

// What became of one mutant. `differs`: its answers are others than the routine's own.
enum class Fate { not_compiled, same, caught, survived };

struct Outcome {
  bool passed = true;
  std::vector<std::uint64_t> fingerprints;
};

// Other paths than the one that verify takes, to see whether a mutant differs anywhere.
constexpr std::array<codegen::PathOptions, 3> others = {
    codegen::PathOptions{1, 240}, codegen::PathOptions{2, 300}, codegen::PathOptions{3, 480}};

Outcome outcome_of(const codegen::CompiledTarget& routine) {
  Outcome out;
  for (const codegen::PathOptions& options : others) {
    const auto path = routine.drive_path(options);
    out.fingerprints.push_back(path->fingerprint);
    if (options.seed != 1) continue;
    out.passed = path->passed();
    if (!out.passed) break; // caught, whatever it does elsewhere
  }
  return out;
}

// Runs in a process of its own, which a mutant may crash or hang.
Fate fate_of(const Exporter& exporter, const ExportRequest& request, const SourceBundle& bundle,
             const BuildVariant& variant, const Outcome& own) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    // What a mutant prints is of no interest.
    if (!std::freopen("/dev/null", "w", stdout) || !std::freopen("/dev/null", "w", stderr))
      _exit(9);
    int code = 9;
    try {
      const codegen::CompiledTarget routine(exporter, request, bundle, variant);
      const Outcome outcome = outcome_of(routine);
      code = !outcome.passed ? 2 : outcome.fingerprints == own.fingerprints ? 1 : 3;
    } catch (const std::exception&) {
      code = 0;
    }
    _exit(code);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFEXITED(status)) return Fate::caught; // crashed or hung: noticed
  switch (WEXITSTATUS(status)) {
  case 0:
    return Fate::not_compiled;
  case 1:
    return Fate::same;
  case 2:
    return Fate::caught;
  case 3:
    return Fate::survived;
  default:
    return Fate::caught; // the routine ended the program
  }
}

struct Arguments {
  std::size_t part = 0, parts = 1;
  std::string target;
  bool survivors = false;
};

Arguments read(int count, char** values) {
  Arguments out;
  for (int i = 1; i < count; ++i) {
    const std::string word = values[i];
    if (word == "--survivors") out.survivors = true;
    if (i + 1 == count) continue;
    if (word == "--target") out.target = values[i + 1];
    if (word == "--part") std::sscanf(values[i + 1], "%zu/%zu", &out.part, &out.parts);
  }
  return out;
}

struct Row {
  std::size_t made = 0, compiled = 0, differ = 0, caught = 0;
};

void run(const Arguments& arguments) {
  std::set<std::string> seen_units;
  std::size_t number = 0;
  Row all;
  fmt::print("| target | mutants | compile | answers differ | caught |\n|---|--:|--:|--:|--:|\n");
  for (const Exporter& exporter : codegen::all_exporters()) {
    Row row;
    for (const char* sample : {"history", "further"}) {
      const table::Table table = std::strcmp(sample, "history") == 0
                                     ? test::history_table()
                                     : test::further_histories_table();
      if (!exporter.is_routine() || exporter.name == "toy") continue;
      const test::SampleRequest sampled(exporter, table, "mm-t-s");
      const ExportRequest request = sampled.get();
      const SourceBundle bundle = exporter.generate(request);
      BuildVariant variant = exporter.variants(request).front();
      if (variant.program() != "gfortran") continue;
      for (const char* flag : {"-O0", "-ffixed-line-length-none"})
        variant.command.push_back(flag);
      const codegen::CompiledTarget original(exporter, request, bundle, variant);
      if (!original.drive_path({})) continue;
      const Outcome own = outcome_of(original);
      for (const auto& [file, text] : bundle) {
        if (!file.ends_with(".f")) continue;
        for (const Mutant& mutant : mutants_of(file, text, seen_units)) {
          if (!arguments.target.empty() && exporter.name != arguments.target) continue;
          if (number++ % arguments.parts != arguments.part) continue;
          ++row.made;
          const Fate fate = fate_of(exporter, request, mutated(bundle, mutant), variant, own);
          row.compiled += fate != Fate::not_compiled;
          row.differ += fate == Fate::caught || fate == Fate::survived;
          row.caught += fate == Fate::caught;
          if (arguments.survivors && fate == Fate::survived)
            fmt::print(stderr, "{} {} {}:{} {}\n    {}\n    {}\n", exporter.name, sample, file,
                       mutant.line + 1, mutant.kind, stripped(lines_of(text)[mutant.line]),
                       mutant.text.empty() ? "(deleted)" : stripped(mutant.text));
        }
      }
    }
    if (row.made == 0) continue;
    fmt::print("| {} | {} | {} | {} | {} |\n", exporter.name, row.made, row.compiled, row.differ,
               row.caught);
    std::fflush(stdout);
    all = {all.made + row.made, all.compiled + row.compiled, all.differ + row.differ,
           all.caught + row.caught};
  }
  fmt::print("| all | {} | {} | {} | {} ({:.1f} %) |\n", all.made, all.compiled, all.differ,
             all.caught, all.differ ? 100.0 * double(all.caught) / double(all.differ) : 100.0);
}

} // namespace

} // namespace frictab::bench

int main(int count, char** values) {
  frictab::bench::run(frictab::bench::read(count, values));
}
