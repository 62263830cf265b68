// Look-alikes of measured campaigns: shapes, designs and sizes of effects are those of real sets,
// every number is drawn here. And masked designs: several columns that hide each other.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "foreign/part.h"

namespace frictab::foreign {

namespace {

constexpr std::size_t unseen = 60;

// Scatter between tests, a slow wander within and a scatter of rows, all relative.
Noise scatter(const Part& part, double between, double slow, double rows, Random& random) {
  Noise noise{Values(part.rows()), {}, between};
  for (std::size_t e = 0; e < part.tests(); ++e) {
    const double gain = std::exp(between * random.normal());
    noise.gains.push_back(gain);
    double wander = random.normal();
    for (std::size_t i = part.first_row[e]; i < part.first_row[e + 1]; ++i) {
      wander = 0.98 * wander + std::sqrt(1 - 0.98 * 0.98) * random.normal();
      noise.factor[i] = gain * std::max(0.1, 1 + slow * wander + rows * random.normal());
    }
  }
  return noise;
}

// One test of a rig that holds its load and speed.
struct Run {
  double sigma, v, distance;
  std::size_t rows;
};

void add_states(Part& part, const std::vector<Run>& runs) {
  Values time, sigma, v, s;
  for (const Run& run : runs) {
    for (std::size_t i = 0; i < run.rows; ++i) {
      // A single row is the mean or the end of its test.
      const double u = static_cast<double>(i + 1) / static_cast<double>(run.rows);
      time.push_back(u * run.distance / run.v);
      s.push_back(u * run.distance);
      sigma.push_back(run.sigma);
      v.push_back(run.v);
    }
    part.first_row.push_back(part.rows() + run.rows);
  }
  part.add({"time_s", "", time, {}});
  part.add({"sigma_n_MPa", "", sigma, {}});
  part.add({"v_rel_mm_s", "", v, {}});
  part.add({"s_mm", "", s, {}});
}

// Set levels of a test: of training by its number, else by chance.
class Levels {
public:
  Levels(bool training, std::size_t test, Random& random)
      : training_(training), rest_(test), random_(random) {}
  // The next factor's level, 0 .. count - 1.
  std::size_t level(std::size_t count) {
    const std::size_t here = training_ ? rest_ % count : random_.below(count);
    rest_ /= count;
    return here;
  }
  // The next factor from low to high in equal ratios, or anywhere between.
  double ratio(std::size_t count, double low, double high) {
    const double u = training_ ? static_cast<double>(level(count)) / static_cast<double>(count - 1)
                               : random_.uniform();
    return low * std::pow(high / low, u);
  }

private:
  bool training_;
  std::size_t rest_;
  Random& random_;
};

std::vector<std::string> lettered(const std::string& name, std::size_t count) {
  std::vector<std::string> levels;
  for (std::size_t i = 0; i < count; ++i)
    levels.push_back(name + static_cast<char>('a' + i));
  return levels;
}

// Levels by chance, all of them in either part.
void add_random_text(Part& part, const std::string& name, std::size_t count, Random& random) {
  Values values;
  for (std::size_t e = 0; e < part.tests(); ++e)
    values.push_back(static_cast<double>(e < count ? e : random.below(count)));
  random.shuffle(std::span<double>(values));
  part.add_per_test(name, values, lettered(name + "_", count));
}

void add_random_numbers(Part& part, const std::string& name, double mean, double deviation,
                        Random& random) {
  Values values;
  for (std::size_t e = 0; e < part.tests(); ++e)
    values.push_back(mean + deviation * random.normal());
  part.add_per_test(name, values);
}

template <class Of> void set_friction(Part& part, Of of) {
  part.law.resize(part.rows());
  for (std::size_t i = 0; i < part.rows(); ++i)
    part.law[i] = of(i);
  part.truth = part.law;
}

const std::vector<std::vector<std::string>> along_tests = {
    {"s_mm"}, {"time_s"}, {"time_since_start"}, {"energy"}, {"friction_work"}};

// Two counter-materials x 4 loads x 4 speeds; friction falls with load and speed, and runs in.
void pin_on_disc(Part& part, bool training, double drawn, Random& random) {
  std::vector<Run> runs;
  Values material, radius, load, rpm;
  for (std::size_t e = 0; e < (training ? 32 : unseen); ++e) {
    Levels levels(training, e, random);
    material.push_back(static_cast<double>(levels.level(2)));
    const double sigma = levels.ratio(4, 0.6, 4.8), v = levels.ratio(4, 30, 350);
    const double most = training ? 3000 : 300, least = training ? 300 : 60;
    runs.push_back({sigma, v, 2e5 * random.uniform(0.8, 1.2),
                    static_cast<std::size_t>(least * std::pow(most / least, random.uniform()))});
    radius.push_back(10 + 3 * static_cast<double>(random.below(4)));
    load.push_back(sigma * 19.6);
    rpm.push_back(v / radius.back() * 9.549);
  }
  add_states(part, runs);
  part.add_per_test("material", material, {"bronze", "steel"});
  part.add_per_test("radius_mm", radius);
  part.add_per_test("load_N", load);
  part.add_per_test("rpm", rpm);
  add_random_text(part, "rotation", 2, random);
  const Values &sigma = part.at("sigma_n_MPa"), &v = part.at("v_rel_mm_s"), &s = part.at("s_mm"),
               &steel = part.at("material");
  set_friction(part, [&](std::size_t i) {
    return sigma[i] * 0.4 * std::pow(sigma[i] / 2, -0.1) * std::pow(v[i] / 100, -0.07) *
           (1 + drawn * 0.16 * steel[i]) * (1 + 0.18 * std::exp(-s[i] / 2.5e4));
  });
}

// Oil with 0/1/10/20 % of an additive x 4 speeds x 3 repeats on 8 chips; a slow fall over cycles.
void reciprocating(Part& part, bool training, double drawn, Random& random) {
  std::vector<Run> runs;
  Values additive;
  const std::size_t rows = training ? 3000 : 100;
  for (std::size_t e = 0; e < (training ? 48 : unseen); ++e) {
    Levels levels(training, e, random);
    additive.push_back(static_cast<double>(levels.level(4)));
    runs.push_back({700, levels.ratio(4, 5, 40), 3e4, rows});
  }
  add_states(part, runs);
  part.add_per_test("additive", additive, {"0", "1", "10", "20"});
  add_random_text(part, "chip", 8, random);
  add_random_numbers(part, "room_C", 22, 0.8, random);
  Values cycle = part.at("s_mm");
  for (double& x : cycle)
    x = std::round(x / 10);
  part.add({"cycle", "", cycle, {}});
  const double level[] = {1, 1 - 0.05 * drawn, 1 - 0.22 * drawn, 1 - 0.18 * drawn};
  const Values &v = part.at("v_rel_mm_s"), &oil = part.at("additive");
  set_friction(part, [&](std::size_t i) {
    return 700 * 0.12 * level[static_cast<std::size_t>(oil[i])] * std::pow(v[i] / 15, -0.09) *
           (1 - 0.12 * cycle[i] / 3000);
  });
}

// 5 powders x 9 stresses x 3 repeats; kPa; cohesion; an approach to the steady state.
void shear_cell(Part& part, bool training, double drawn, Random& random) {
  std::vector<Run> runs;
  Values powder;
  for (std::size_t e = 0; e < (training ? 135 : unseen); ++e) {
    Levels levels(training, e, random);
    powder.push_back(static_cast<double>(levels.level(5)));
    runs.push_back({levels.ratio(9, 5e-4, 1.6e-2), 0.05, 5, 20 + random.below(181)});
  }
  add_states(part, runs);
  part.add_per_test("material", powder, lettered("powder_", 5));
  add_random_text(part, "cell", 2, random);
  add_random_text(part, "operator", 3, random);
  const double cohesion[] = {1e-4, 6e-4, 2.5e-4, 9e-4, 4e-4};
  const double mu[] = {0.42, 0.55, 0.48, 0.62, 0.5};
  const Values &sigma = part.at("sigma_n_MPa"), &s = part.at("s_mm"), &m = part.at("material");
  set_friction(part, [&](std::size_t i) {
    const auto level = static_cast<std::size_t>(m[i]);
    return (drawn * cohesion[level] + mu[level] * sigma[i]) * (1 - 0.4 * std::exp(-s[i] / 0.5));
  });
}

// A design of experiments with one value per test: load x speed x distance, composition by thirds.
void one_row(Part& part, bool training, double drawn, Random& random) {
  std::vector<Run> runs;
  Values composition;
  for (std::size_t e = 0; e < (training ? 27 : unseen); ++e) {
    Levels levels(training, e, random);
    runs.push_back({levels.ratio(3, 0.5, 2), levels.ratio(3, 500, 2000), 0, 1});
    runs.back().distance = levels.ratio(3, 5e5, 2e6);
    composition.push_back(
        5.0 * static_cast<double>(training ? (e + e / 3 + e / 9) % 3 : random.below(3)));
  }
  add_states(part, runs);
  part.add_per_test("composition_pct", composition);
  const Values &sigma = part.at("sigma_n_MPa"), &v = part.at("v_rel_mm_s"), &s = part.at("s_mm"),
               &filler = part.at("composition_pct");
  set_friction(part, [&](std::size_t i) {
    return sigma[i] * 0.4 * std::pow(sigma[i], -0.12) * std::pow(v[i] / 1000, 0.05) *
           std::pow(s[i] / 1e6, 0.04) * (1 - drawn * 0.02 * filler[i]);
  });
}

// 3 tests each without and with three shares of a filler: 20 % more with any; runs in.
void composite(Part& part, bool training, double drawn, Random& random) {
  std::vector<Run> runs;
  Values filler;
  for (std::size_t e = 0; e < (training ? 12 : unseen); ++e) {
    runs.push_back({1, 200, 8e4, training ? std::size_t{400} : 100});
    filler.push_back(static_cast<double>(training ? e / 3 : random.below(4)));
  }
  add_states(part, runs);
  part.add_per_test("filler", filler, {"0", "2.5", "5", "7.5"});
  add_random_text(part, "operator", 2, random);
  add_random_numbers(part, "room_C", 22, 1, random);
  const Values &s = part.at("s_mm"), &with = part.at("filler");
  set_friction(part, [&](std::size_t i) {
    return 0.35 * (with[i] > 0 ? 1 + 0.2 * drawn : 1) * (1 - 0.3 * std::exp(-s[i] / 8e3));
  });
}

struct LookAlike {
  const char* kind;
  void (*make)(Part& part, bool training, double drawn, Random& random);
  double between, slow, rows; // scatter
  std::vector<Cause> causes;
};

const std::vector<LookAlike>& look_alikes() {
  static const std::vector<LookAlike> all = {
      {"pin_on_disc",
       pin_on_disc,
       0.05,
       0.03,
       0.04,
       {{"load", {{"sigma_n_MPa"}, {"friction_power"}}},
        {"speed", {{"v_rel_mm_s"}, {"rpm", "radius_mm"}, {"friction_power"}}},
        {"material", {{"material"}}},
        {"running-in", along_tests}}},
      {"reciprocating",
       reciprocating,
       0.14,
       0.03,
       0.02,
       {{"additive", {{"additive"}}}, {"speed", {{"v_rel_mm_s"}}}, {"cycles", along_tests}}},
      {"shear_cell",
       shear_cell,
       0.05,
       0.02,
       0.01,
       {{"material", {{"material"}}}, {"cohesion", {{"sigma_n_MPa"}}}, {"approach", along_tests}}},
      {"one_row",
       one_row,
       0.05,
       0,
       0,
       {{"composition", {{"composition_pct"}}},
        {"load", {{"sigma_n_MPa"}}},
        {"speed", {{"v_rel_mm_s"}}},
        {"distance", along_tests}}},
      {"composite",
       composite,
       0.07,
       0.03,
       0.03,
       {{"filler", {{"filler"}}}, {"running-in", along_tests}}}};
  return all;
}

} // namespace

Draft look_alike_draft(const Options& options, Random& random) {
  for (const LookAlike& look_alike : look_alikes()) {
    if (options.kind != look_alike.kind) continue;
    Draft draft;
    const double drawn = random.uniform(0.85, 1.15);
    look_alike.make(draft.parts.training, true, drawn, random);
    look_alike.make(draft.parts.validation, false, drawn, random);
    const auto noise = [&](const Part& part) {
      return scatter(part, look_alike.between, look_alike.slow, look_alike.rows, random);
    };
    draft.training = noise(draft.parts.training);
    draft.validation = noise(draft.parts.validation);
    draft.base = "coulomb";
    draft.causes = look_alike.causes;
    return draft;
  }
  throw std::invalid_argument("kind " + options.kind);
}

} // namespace frictab::foreign
