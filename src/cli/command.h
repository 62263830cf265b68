// One subcommand = one file in src/cli/ that registers itself. Declaring options touches no file.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/registry.h"
#include "io/atomic_file.h"

namespace CLI {
class App;
}

namespace frictab::cli {

// Options of every command.
struct CommonOptions {
  std::string output; // -o DIR; empty: the job's output directory
  bool force = false;
  unsigned threads = 0; // -j N, 0 = all cores
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> set; // --set key=value
  std::optional<bool> progress; // --[no-]progress; absent: on a terminal only
  bool dry_run = false;
};

// The common options that change what a command does, and that its help therefore shows. The others
// are accepted as well, so that a script can give the same ones to every command.
enum Uses : unsigned {
  uses_output = 1,
  uses_force = 2,
  uses_threads = 4,
  uses_quiet = 8,
  uses_verbose = 16,
  uses_json = 32,
  uses_seed = 64,
  uses_set = 128,
  uses_progress = 256,
  uses_dry_run = 512,
  stage_uses = uses_output | uses_threads | uses_quiet | uses_json | uses_seed | uses_set |
               uses_progress | uses_dry_run | uses_force, // for a command that runs stages of a job
};

struct Example {
  std::string command; // "frictab run job.toml"
  std::string does;    // a few words on its effect
};

struct Command {
  std::string name; // "table info": the command `info` below the command `table`
  int order = 0;
  std::string title; // one line for the command list
  // Adds the command's own options to `app` and returns the function that runs it, with exit code 0
  // or 1; faults are thrown. Results go to stdout or files; notes to stderr through note() below.
  // nullptr: only the commands below this one can be run.
  std::function<int()> (*declare)(CLI::App& app, const CommonOptions& common) = nullptr;
  unsigned uses = 0; // bits of Uses
  std::vector<Example> examples = {};
};

// Check the text of a number for CLI::Option::check: return its fault, "" for a valid one.
std::string positive_number(const std::string& text);
std::string number_from_0(const std::string& text);

// Reports the current exception on stderr, from within a catch block, and returns its exit code.
int print_exception();

// Writes to stdout after `printable` (core/text.h), so that text from files cannot move the cursor.
void show(const std::string& text);

// Writes a line to stderr, unless -q.
void note(const CommonOptions& common, const std::string& line);

// Moves the staged files into place. Throws InputError where the directory has other files of these
// names and --force is not given.
void commit(io::OutputFiles& files, const std::string& directory, const CommonOptions& common);

} // namespace frictab::cli
