// The forming processes, each a billet, a die and a path:
//   ring       a ring between flat platens, to a share of its height. Its inner radius shrinks with
//              friction and grows without: the classical test of friction (Male, Cockcroft 1964).
//   upsetting  a solid cylinder between the same platens,
//   rod        forward rod extrusion: a bar is pushed from a container through a cone.
// Ring and cylinder are modelled by their upper half; both platens move, each at half the speed.
// Strokes and forces are those of the whole process.
#pragma once

#include <string>
#include <vector>

#include "material.h"
#include "records.h"

struct Setup {
  std::string process = "ring";
  std::string law = "none";
  double outer_diameter = 18, inner_diameter = 9, height = 6; // mm, of the whole billet
  double reduction = 0.5;                                     // ring, upsetting: share of height
  double stroke = 5, exit_diameter = 9, half_angle = 15, corner = 0.8; // rod: mm, mm, deg, mm
  double press_fit = 0.002; // rod: mm of radius that the bar is wider than the container
  double speed = 50;        // mm/s
  double temperature = 20;  // degC, of the billet at the start
  Material material;
  HeatData heat;
  std::size_t columns = 12, rows = 6, steps = 40;
  double penalty = 1e6;          // MPa/mm
  double sticking_share = 0.006; // v0 of contact.h, share of the speed
  double soft_pressure = 5;      // p0, MPa
};

struct StepRecord {
  double stroke = 0, reduction = 0; // mm, share of the height (rod: of the billet's length)
  double force = 0;                 // kN
  double inner_mid = 0, inner_top = 0, inner_mean = 0, outer_mid = 0, outer_top = 0; // mm
  double mean_temperature = 0, mean_pressure = 0; // over the contact area, degC and MPa
  double outside = 0;                             // share of the contact area, by the routine
  double volume = 0;                              // mm^3
  double work = 0;                                // of the force, N mm
  Energies energies;
  double friction_error = 0; // largest |tau - tau_R factors| of a touching point, MPa
  double imbalance = 0;      // |force of the die - force of the bottom|, share of the force
  int iterations = 0;
};

struct Result {
  std::vector<StepRecord> steps; // steps[0] is the start
  std::vector<std::vector<ContactRecord>> contact;
  double first_volume = 0;
  std::size_t sliding_points = 0;
  const StepRecord& last() const { return steps.back(); }
};

Setup default_setup(const std::string& process);
Result run_process(const Setup& setup);

// NAME_force.csv: one line per step; NAME_contact.csv: the contact points of each `every`-th step.
void write_result(const Result& result, const std::string& name, std::size_t every);
