// The pieces that synthetic campaigns are made of.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "core/random.h"
#include "foreign/campaigns.h"

namespace frictab::foreign {

using Values = std::vector<double>;

// Training or held-out tests while they are made. Some columns may never be recorded.
struct Part {
  std::vector<std::size_t> first_row{0};
  std::vector<data::Column> columns;
  Values place; // of each test in the order of tests, 0 .. 1
  Values law;   // friction by the base truth, MPa
  Values truth; // the same with effects

  std::size_t tests() const { return first_row.size() - 1; }
  std::size_t rows() const { return first_row.back(); }
  const Values& at(const std::string& name) const;
  bool has(const std::string& name) const;
  void add(data::Column column);
  void add_per_test(const std::string& name, const Values& values,
                    std::vector<std::string> levels = {});
  Values per_test(const std::string& name) const; // of each test's first row
  Values spread(const Values& per_test) const;    // one value per test -> one per row
};

struct Parts {
  Part training, validation;
};

// --- states and designs -------------------------------------------------------------------------

using Point = std::array<double, 4>; // set levels of a test, each 0 .. 1

std::vector<Point> design(const Options& options, Random& random);
std::vector<Point> held_out_points(const std::vector<Point>& training, std::size_t count,
                                   Random& random);
std::size_t rows_of_a_test(const std::string& kind, Random& random);

// How the tests of a campaign are driven.
struct Program {
  int pressure = 0; // 0 rising, 1 falling, 2 pulsing, 3 cyclic, 4 up and down, 5 by test
  int speed = 0;    // 0 up, 1 down, 2 waves, 3 one step, 4 nearly constant, 5 by test
  double heat = 0.004, settle_s = 1, psi_power = 1, hardening = 0.2;
  double yield_MPa = 900;
  bool hardens = true;
};
Program draw_program(const std::string& effect, Random& random);
void simulate(Part& part, const Program& program, const Point& point, std::size_t rows,
              Random& random);

// --- bystanders ---------------------------------------------------------------------------------

// Recorded columns that friction may or may not follow; both parts come from the same laboratory.
void add_bystanders(Parts& parts, Random& random);

// --- friction -----------------------------------------------------------------------------------

void add_friction(Parts& parts, const std::string& truth, Random& random);
// Exponent of friction's factor per row: factor = exp(amplitude * shape).
using Shape = std::function<Values(const Part&)>;
// What makes the truth "unlike any law" so, on top of a law.
Shape unlike_any_law(const Part& training, Random& random);
std::string base_law(const std::string& truth); // the registered law that is calibrated

// The base law by least squares, as the tool would refit it: held-out prediction.
Values refitted(const std::string& base, const Part& training, const Values& measured,
                const Part& validation);
double mean_error(const Values& measured, const Values& predicted);
Values limited(const Part& part, Values tau); // by the shear yield stress, where it is recorded

struct Noise {
  Values factor;           // per row
  Values gains;            // per test, part of the factors
  double gain_scatter = 0; // standard deviation of what the gains came from, without outlying tests
};
Noise draw_noise(const std::string& kind, const Part& part, Random& random);

// --- effects ------------------------------------------------------------------------------------

struct EffectKind {
  std::string name;
  std::vector<std::vector<std::string>> answers;
  bool within = false; // needs several rows per test
  // Thresholds and levels are drawn from the training tests, and hold for all.
  Shape (*make)(const Part& training, Random& random) = nullptr;
};
const std::vector<EffectKind>& effects();
const std::vector<EffectKind>& hidden_effects(); // their column is not recorded; no answers
const EffectKind* find_kind(const std::string& name);

// --- whole campaigns ----------------------------------------------------------------------------

// Everything but the kind "forging"; parts with truth, causes and the names of recorded columns.
struct Draft {
  Parts parts;
  Noise training, validation;
  std::string base;
  std::vector<Cause> causes;
  std::vector<std::string> hidden; // columns that are not recorded
  bool absorbed = false;
};
Draft masked_draft(const Options& options, Random& random);
Draft look_alike_draft(const Options& options, Random& random);

Values standardised(const Values& values, const Values& of); // by mean and deviation of `of`
double quantile(Values values, double share);

} // namespace frictab::foreign
