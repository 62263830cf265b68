#include "foreign/cases.h"

#include <fmt/format.h>

#include "core/random.h"

namespace frictab::foreign {

namespace {

template <class T, std::size_t n> const T& one_of(const T (&items)[n], Random& random) {
  return items[random.below(n)];
}

std::uint64_t number_of(const std::string& name) {
  std::uint64_t number = 14695981039346656037u; // FNV-1a
  for (const char c : name)
    number = (number ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return number;
}

constexpr std::size_t sizes[] = {12, 20, 24, 40, 81};
constexpr const char* row_kinds[] = {"one", "few", "equal", "many", "unequal", "wild"};
constexpr const char* truths[] = {"coulomb", "log_coulomb", "orowan"};

// Everything but the effect is drawn, the same for every strength.
Options drawn(const std::string& name, std::uint64_t seed) {
  Random random(seed, number_of(name));
  Options options;
  options.seed = seed * 1000003 + number_of(name) % 1000003;
  const auto designs = design_kinds(), noises = noise_kinds();
  options.design = designs[random.below(designs.size())];
  options.noise = noises[random.below(noises.size())];
  options.tests = one_of(sizes, random);
  options.rows = one_of(row_kinds, random);
  options.truth = one_of(truths, random);
  return options;
}

Options with_effect(const std::string& effect, double strength, std::uint64_t seed,
                    bool wrong_base) {
  Options options = drawn(effect, seed);
  Random random(options.seed, 70);
  if (within_tests(effect))
    while (options.rows == "one" || options.rows == "few")
      options.rows = one_of(row_kinds, random);
  // Every fifth base law is wrong itself.
  if (wrong_base && random.below(5) == 0) options.truth = "unlike any law";
  options.effect = effect;
  options.strength = strength;
  return options;
}

void add_effects(std::vector<Case>& cases, const Counts& counts) {
  for (const std::string& effect : effect_kinds())
    for (const double strength : counts.strengths)
      for (std::size_t s = 0; s < counts.seeds; ++s)
        cases.push_back(
            {"effect", effect, "", with_effect(effect, strength, counts.first_seed + s, true)});
}

void add_hidden(std::vector<Case>& cases, const Counts& counts) {
  for (const std::string& effect : hidden_kinds())
    for (const double strength : counts.strengths)
      for (std::size_t s = 0; s < 4 * counts.seeds; ++s)
        cases.push_back({"hidden", effect, "",
                         with_effect(effect, strength, 100 * counts.first_seed + s, false)});
}

void add_masked(std::vector<Case>& cases, const Counts& counts) {
  constexpr std::pair<std::size_t, std::size_t> designs[] = {{12, 1}, {12, 2}, {16, 2}, {24, 2},
                                                             {24, 3}, {32, 3}, {48, 3}};
  for (const double factor : counts.factors)
    for (const auto& [tests, columns] : designs)
      for (std::size_t s = 0; s < counts.masked_seeds; ++s) {
        Options options;
        options.kind = "masked";
        options.seed = 5000 * counts.first_seed + s;
        options.rows = row_kinds[s / 2 % 3];
        options.design = options.noise = "own";
        options.tests = tests;
        options.masked_columns = columns;
        options.masked_factor = factor;
        cases.push_back({"masked",
                         fmt::format("{} tests, {} columns, x{:g}", tests, columns, factor), "",
                         options});
      }
}

// Over all kinds of noise and all designs in turn; sizes, rows and laws are drawn.
void add_nulls(std::vector<Case>& cases, const Counts& counts) {
  const auto designs = design_kinds(), noises = noise_kinds();
  for (std::size_t i = 0; i < counts.nulls; ++i) {
    Options options = drawn(fmt::format("null {}", i), counts.first_seed);
    options.noise = noises[i % noises.size()];
    options.design = designs[i / noises.size() % designs.size()];
    options.tests = sizes[(i / 3) % std::size(sizes)];
    cases.push_back({"null", fmt::format("{} {}", options.noise, options.design), "", options});
  }
}

void add_misfits(std::vector<Case>& cases, const Counts& counts) {
  for (const std::string& noise : noise_kinds())
    for (std::size_t s = 0; s < counts.seeds; ++s) {
      Options options = drawn("misfit " + noise, counts.first_seed + s);
      options.noise = noise;
      options.truth = "unlike any law";
      cases.push_back({"misfit", noise, "", options});
    }
}

void add_worlds_apart(std::vector<Case>& cases, const Counts& counts) {
  for (std::size_t s = 0; s < 6 * counts.seeds; ++s)
    for (const bool absolute : {true, false}) {
      Options options = drawn("apart", 100 * counts.first_seed + s);
      (absolute ? options.shift_MPa : options.shift_share) = absolute ? 57 : 0.08;
      cases.push_back({"apart", absolute ? "+57 MPa" : "+8 %", "", options});
    }
}

Options look_alike(const std::string& kind, std::uint64_t seed) {
  Options options;
  options.kind = kind;
  options.seed = seed;
  options.design = options.noise = options.rows = "own";
  const std::pair<const char*, std::size_t> tests[] = {{"pin_on_disc", 32},
                                                       {"reciprocating", 48},
                                                       {"shear_cell", 135},
                                                       {"one_row", 27},
                                                       {"composite", 12}};
  for (const auto& [name, count] : tests)
    if (kind == name) options.tests = count;
  return options;
}

void add_look_alikes(std::vector<Case>& cases, const Counts& counts) {
  for (const char* kind : {"pin_on_disc", "reciprocating", "shear_cell", "one_row", "composite"})
    for (std::size_t s = 0; s < 2 * counts.seeds; ++s)
      cases.push_back({"look-alike", kind, "", look_alike(kind, 100 * counts.first_seed + s)});
}

// Laws whose form does not know the unit of stress: ratios alone.
std::vector<std::pair<std::string, Options>> bases_of_invariance(std::uint64_t seed) {
  std::vector<std::pair<std::string, Options>> bases;
  for (const char* kind : {"reciprocating", "shear_cell", "one_row", "composite"})
    bases.push_back({kind, look_alike(kind, 7000 + seed)});
  Options masked = look_alike("masked", 7000 + seed);
  masked.tests = 24;
  masked.rows = "few";
  masked.masked_columns = 2;
  bases.push_back({"masked", masked});
  for (const char* effect : {"", "humidity power", "levels of an additive", "energy"}) {
    Options options = drawn(std::string("invariance ") + effect, seed);
    options.truth = "coulomb";
    options.tests = 40;
    options.rows = "equal";
    options.effect = effect == std::string("energy") ? "saturates with energy" : effect;
    options.strength = 0.15;
    bases.push_back({*effect ? options.effect : "nothing", options});
  }
  return bases;
}

void add_invariance(std::vector<Case>& cases, const Counts& counts) {
  for (std::size_t s = 0; s < counts.seeds; ++s)
    for (const auto& [name, base] : bases_of_invariance(counts.first_seed + s)) {
      const auto add = [&](const std::string& variant, auto change) {
        Options options = base;
        change(options);
        cases.push_back({"invariance", name, variant, options});
      };
      add("as it is", [](Options&) {});
      for (const double unit : {1e-6, 1e-3, 1e3, 1e6})
        add(fmt::format("stresses x {:g}", unit), [&](Options& o) { o.stress_unit = unit; });
      add("friction x (1 + 1e-7 noise)", [](Options& o) { o.jitter = 1e-7; });
      add("columns in another order", [](Options& o) { o.other_columns = true; });
      add("tests in another order", [](Options& o) { o.other_tests = true; });
    }
}

} // namespace

std::vector<Case> all_cases(const Counts& counts) {
  std::vector<Case> cases;
  add_effects(cases, counts);
  add_masked(cases, counts);
  add_nulls(cases, counts);
  add_misfits(cases, counts);
  add_hidden(cases, counts);
  add_worlds_apart(cases, counts);
  add_look_alikes(cases, counts);
  add_invariance(cases, counts);
  std::erase_if(cases, [&](const Case& c) {
    return (c.group + " " + c.name + " " + c.variant).find(counts.only) == std::string::npos;
  });
  return cases;
}

} // namespace frictab::foreign
