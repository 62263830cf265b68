// Facts about this process, its terminal and its machine.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

namespace frictab::os {

double machine_memory();             // bytes
double stack_limit();                // bytes
double peak_memory();                // bytes that this process has used at most; 0: unknown
bool is_terminal(std::FILE* stream); // stdout or stderr
std::size_t terminal_width();        // columns of stderr's terminal; 80: unknown
int process_id();                    // unique on this machine while the process lives
std::string host_name();             // "": unknown

} // namespace frictab::os
