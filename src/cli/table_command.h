// Functions that the commands below `frictab table` share with others that write one file.
#pragma once

#include <functional>
#include <ostream>

#include "cli/command.h"

namespace CLI {
class Option;
}

namespace frictab::cli {

// Makes -o the name of one file, which the command writes instead of stdout.
void output_is_a_file(CLI::App& app);

// Writes to -o FILE, complete or not at all, or to stdout without -o. Throws InputError where the
// file exists with other content and --force is not given.
void write_result(const CommonOptions& common, const std::function<void(std::ostream&)>& write);

// Adds --at NAME=VALUE, which may be repeated.
void add_fixed_states_option(CLI::App& app, std::vector<std::string>& at);

} // namespace frictab::cli
