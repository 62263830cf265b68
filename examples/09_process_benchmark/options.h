// The command line: which process, and its numbers with meaning and limits.
#pragma once

#include <string>

#include "process.h"

struct Command {
  bool help = false;
  Setup setup;
  std::string output;                               // prefix of the files, none if empty
  double every = 4;                                 // contact points of each so many steps
  double ccx_force = 0, ccx_radius = 0, ccx_mu = 0; // check: what CalculiX gives; 0: not there
};

// Throws std::invalid_argument with a message for the user.
Command read_command(int count, char** words);
std::string usage();
