// [process] of a job: the user's own forming simulation, in which the laws are judged.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "data/options.h"

namespace frictab::process {

// Drive of the tool. Friction changes the force only under a given displacement.
enum class Driven { automatic, displacement, force, energy };

struct ProcessOptions {
  std::vector<std::string> contact; // files of contact states; empty: no process
  std::vector<std::string> tool;    // force and speed of the tool over time; empty: not known
  std::string used;                 // law that the simulation had: a name, or "coulomb:0.08"
  double symmetry = 1;              // the tool's force acts on so many times the areas given
  Driven driven = Driven::automatic;
  bool fixed_contact = true; // false: another friction gives another contact, as in die filling
  std::map<std::string, data::ColumnSource> columns;      // of the contact files
  std::map<std::string, data::ColumnSource> tool_columns; // of the tool's
  std::map<std::string, double> constants; // states that the files lack, canonical units
  std::string flow_curve;                  // a file of plastic_strain and sigma_f_MPa
  std::map<std::string, std::pair<double, double>> rig; // what tests can be set to
  std::size_t tests = 4;                                // to propose
  std::size_t repeats = 2;                              // of them, to know the scatter
  std::size_t resamples = 60;   // of the tests, with laws fitted and chosen again
  std::vector<std::string> add; // files of further tests, to say what the laws say with them
  std::string base;             // base directory of relative paths
  Place place;                  // of [process]
};

} // namespace frictab::process
