// The synthetic tribometer: a sliding-compression campaign with known physics, noise and planted
// effects, so that everything downstream can be checked against the truth. Nothing here is
// measured; every file is marked "synthetic".
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/dataset.h"
#include "effects/effect.h"
#include "twin/twin_design.h"
#include "twin/twin_law.h"
#include "twin/twin_physics.h"

namespace frictab::twin {

// An effect as requested: "form=saturation,column=s_mm,strength=0.15,on=mu".
struct EffectSpec {
  std::string form;    // name in the effect registry
  std::string column;  // recorded column, derived quantity, or "latent"
  std::string column2; // for forms of two or three columns
  std::string column3; // for forms of three columns
  // mu, m or tau; effects added to tau are in units of the mean noise-free tau
  effects::ActsOn on = effects::ActsOn::mu;
  std::string latent = "random"; // random | groups | batch | drift | order
  // relative increase of the training MAE of the recalibrated law without the effect, above the
  // noise floor
  std::optional<double> strength;
  std::optional<double> amplitude; // the form's amplitude itself, instead of a strength
  int sign = 0;                    // of the amplitude; 0: positive if that reaches the strength
  std::map<std::string, double> shapes; // shape parameters by name, in units of the column
};

// Parses the option. Throws InputError with every fault; names the nearest form, key or parameter.
EffectSpec parse_effect(std::string_view text);

struct PlantedEffect {
  EffectSpec spec;
  const effects::EffectForm* form = nullptr;
  std::vector<double> parameters; // in the form's order
  double strength = 0;            // strength reached with this effect alone
  // with levels or knots if the form has them: their factors are its pattern times the amplitude
  effects::PlacedEffect placed;
};

// Returns the columns that the form takes, one name each.
std::vector<std::string> columns_of(const EffectSpec& spec);

// Relative standard deviations that replace those of the parameter set.
struct TwinScatter {
  std::optional<double> test;  // between tests, by one hidden factor each
  std::optional<double> slow;  // within a test, autocorrelated
  std::optional<double> rho;   // correlation from row to row, of `slow`
  std::optional<double> white; // from row to row
};

// Parses "test=0.04,slow=0.035,rho=0.95,white=0.012", any subset. Throws InputError with every
// fault.
TwinScatter parse_scatter(std::string_view text);

struct TwinOptions {
  std::string set = "D";
  // Chosen because 30 validation experiments scatter: of the seeds 1..8 this one comes closest to
  // the published figures (51 / 24 / 95 MPa for the constants, 12-15 calibrated).
  std::uint64_t seed = 3;
  std::optional<TwinDesign> design; // absent: default_design
  // A law of the registry as the noise-free truth, with parameters fitted to the twin's own
  // physics. Empty: that physics, which no registered law can represent.
  std::string law;
  // Contact normal stress over the stroke: constant | varied (constant, rising, falling or with a
  // pulse, depending on the test), so that momentary, highest and mean stress are different
  // columns.
  std::string profile = "constant";
  double noise_scale = 1;       // 0..5, multiplies every source of noise
  std::string noise = "normal"; // normal | t4 (heavy tails) | heteroscedastic (grows with v)
  TwinScatter scatter;
  std::vector<EffectSpec> effects;
  bool bystanders = true;
  // Adds film2_um (follows film_um, has no effect), vib, lab_T_C, dwell_s, direction, batch.
  bool more_bystanders = false;
  std::vector<std::string> hide; // columns left out of the files; they may still cause an effect
};

struct TwinPart {
  data::Dataset data;
  std::vector<double> oracle_MPa; // noise-free tau per row, with effects, without the hidden factor
  std::vector<double> base_MPa;   // the same without the effects
  std::vector<double> recalibrated_MPa; // tau of the law with Twin::recalibrated; else empty
};

struct Twin {
  TwinOptions options; // with the design filled in
  TwinParameters set;
  TwinPart training;
  TwinPart validation;
  std::vector<PlantedEffect> effects;
  std::shared_ptr<const LawTruth> law; // empty: the twin's own physics
  // For a law as truth: its parameters by least squares on the training measurements, without the
  // effects; empty where none are planted.
  std::vector<double> recalibrated;
};

// Noise levels of a campaign before noise_scale.
struct TwinNoise {
  double test, slow, rho, white;
};
TwinNoise noise_of(const TwinOptions& options, const TwinParameters& set);

// Throws InputError with every value that is unknown or out of range.
void check_options(const TwinOptions& options);

// Makes the campaign: same options, same bits, on any number of threads. Throws InputError for
// faults that the user can correct.
Twin make_twin(TwinOptions options);

// Returns "synthetic (frictab twin, set D, seed 1)", the value of column `origin`.
std::string twin_origin(const TwinOptions& options);

} // namespace frictab::twin
