// Contact states of a forming simulation: where, when and how its surfaces rub.
//
// One row is one facet (or node) in contact at one written increment. It stands for its area A,
// times the symmetry, and for the time dt since the increment before. Friction power is the sum of
// tau v A over the rows of an increment; a force on a tool at speed V that overcomes it is that sum
// over V.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/dataset.h"
#include "process/options.h"

namespace frictab::process {

// The tool at the written increments.
struct Tool {
  std::vector<double> force_kN, speed_mm_s;
  std::vector<double> stroke_mm;    // empty: not given
  std::optional<double> friction_J; // that the solver summed over the written increments
};

// A state that the files lack: the same value at every contact.
struct Held {
  std::string state, unit;
  double value = 0;
  std::string why;
  double low = 0, high = 0; // between which it lies in four fifths of the tests' rows
  double cost_percent = 0;  // largest change of a law's result between the two
};

// Returns the place of its first file, for faults.
Place place_of(const data::Dataset& data);

struct ContactHistory {
  // States per row, in canonical units. Each facet is an experiment, its rows in time order, so
  // that histories run along it.
  data::Dataset states;
  std::vector<std::size_t> increment; // per row
  std::vector<double> time_s;         // of each written increment
  double start_s = 0;                 // when the first increment began
  std::vector<double> area_mm2, dt_s; // per row, of the whole process
  std::vector<double> tau_MPa;        // of the solver, per row; empty: not given
  std::vector<double> place_mm;       // per row, along the direction of most extent; empty: unknown
  std::string place_name;             // "r"
  std::optional<Tool> tool;
  std::vector<Held> held;
  std::vector<std::string> notes; // what was left out, converted, derived
  std::size_t facets = 0;

  std::size_t rows() const { return increment.size(); }
  Place place() const { return place_of(states); }
  std::span<const double> speed() const { return states.values("v_rel_mm_s"); }
  double step(std::size_t increment) const; // its duration, s
  // The rows of an increment added up.
  std::vector<double> per_increment(std::span<const double> values) const;
  // tau v A dt of each row, J.
  std::vector<double> work_J(std::span<const double> tau_MPa) const;
  // tau v A of each increment, W.
  std::vector<double> power_W(std::span<const double> tau_MPa) const;
  // Increments of the late half of the time, in which the tool moves.
  std::vector<std::size_t> late() const;
};

// Reads the files and derives what they lack: the speed from slips (as a vector), the path from the
// speed, psi from areas, the flow stress from a curve. Rows without pressure or area are left out
// and counted. Throws InputError for files that cannot be used.
ContactHistory read_contact(const ProcessOptions& options);

// Adds the inputs that the files lack, each held at the job's constant or at the middle of the
// tests. `levels`: of inputs that are text columns. Throws InputError for an input that the tests
// lack too.
void hold_missing(ContactHistory& history, std::span<const std::string> inputs,
                  const std::map<std::string, std::vector<std::string>>& levels,
                  const data::Dataset& tests);

} // namespace frictab::process
