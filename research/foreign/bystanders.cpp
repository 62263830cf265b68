// Columns that friction may or may not follow, as laboratories record them.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "foreign/part.h"

namespace frictab::foreign {

namespace {

// Both parts at once: columns that follow the order of tests go through all of them.
class Laboratory {
public:
  Laboratory(Parts& parts, Random& random) : parts_(parts), random_(random) {}

  void numbers(const std::string& name, const std::function<double(double place)>& value) {
    for (Part* part : {&parts_.training, &parts_.validation}) {
      Values values;
      for (const double place : part->place)
        values.push_back(value(place));
      part->add_per_test(name, values);
    }
  }

  // Levels of a text column; those that no training test has are not met later either.
  void text(const std::string& name, const std::vector<std::string>& levels,
            const std::function<std::size_t(double place)>& level) {
    std::vector<bool> seen(levels.size());
    Values values[2];
    for (const double place : parts_.training.place) {
      values[0].push_back(static_cast<double>(level(place)));
      seen[static_cast<std::size_t>(values[0].back())] = true;
    }
    for (const double place : parts_.validation.place) {
      std::size_t here = level(place);
      while (!seen[here])
        here = (here + 1) % levels.size();
      values[1].push_back(static_cast<double>(here));
    }
    parts_.training.add_per_test(name, values[0], levels);
    parts_.validation.add_per_test(name, values[1], levels);
  }

  void by_chance(const std::string& name, const std::vector<std::string>& levels) {
    text(name, levels, [&](double) { return random_.below(levels.size()); });
  }

private:
  Parts& parts_;
  Random& random_;
};

// A walk over the order of all tests, known at 200 places.
Values random_walk(Random& random) {
  Values walk(200);
  double at = 0;
  for (double& x : walk)
    x = at += random.normal();
  return walk;
}

std::vector<std::string> numbered(const char* format, std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i)
    names.push_back(fmt::format(fmt::runtime(format), i + 1));
  return names;
}

std::size_t block(double place, std::size_t blocks) {
  return std::min(blocks - 1, static_cast<std::size_t>(place * static_cast<double>(blocks)));
}

void add_order(Laboratory& laboratory, Parts& parts, Random& random) {
  const Values walk = random_walk(random);
  laboratory.numbers("bench_drift", [&](double p) { return walk[block(p, walk.size())]; });
  const std::size_t days = 3 + random.below(10);
  laboratory.text("lab_day", numbered("day_{:02}", days), [&](double p) { return block(p, days); });
  laboratory.numbers("room_C", [&](double p) { return 20 + 4 * p + 0.6 * random.normal(); });
  const double n = static_cast<double>(parts.training.tests());
  Values sorted = parts.training.place;
  std::sort(sorted.begin(), sorted.end());
  laboratory.numbers("run_order", [&](double p) {
    const auto rank = std::lower_bound(sorted.begin(), sorted.end(), p) - sorted.begin();
    return std::min(n, static_cast<double>(rank) + 1);
  });
}

void add_independent(Laboratory& laboratory, Random& random) {
  laboratory.numbers("Ra_um", [&](double) { return 0.2 * std::pow(10, random.uniform()); });
  laboratory.numbers("humidity_pct", [&](double) { return random.uniform(25, 75); });
  laboratory.numbers("lube_g_m2", [&](double) { return 5 + 4 * std::abs(random.normal()); });
  laboratory.numbers("pause_s", [&](double) { return 5 * std::pow(720, random.uniform()); });
  laboratory.numbers("cleaned", [&](double) { return static_cast<double>(random.below(2)); });
  laboratory.numbers("new_pin", [&](double) { return random.uniform() < 0.3 ? 1.0 : 0.0; });
  laboratory.by_chance("lot", numbered("lot_{}", 2 + random.below(3)));
  laboratory.by_chance("additive", {"0", "1", "10", "20"});
  laboratory.by_chance("tool", {"A", "B"});
  laboratory.by_chance("operator", {"ann", "ben", "cy"});
}

// 0.9 with another recorded column.
void add_correlated(Parts& parts, Random& random) {
  const char* partners[] = {"T_tool_C", "humidity_pct", "Ra_um", "lube_g_m2"};
  const std::string partner = partners[random.below(std::size(partners))];
  const Values of = parts.training.per_test(partner);
  for (Part* part : {&parts.training, &parts.validation}) {
    Values values = standardised(part->per_test(partner), of);
    for (double& x : values)
      x = 3 + 0.2 * (0.9 * x + std::sqrt(1 - 0.81) * random.normal());
    part->add_per_test("gauge_V", values);
  }
}

// Noise of its own along every test, with some memory.
void add_hiss(Parts& parts, Random& random) {
  for (Part* part : {&parts.training, &parts.validation}) {
    Values values;
    for (std::size_t e = 0; e < part->tests(); ++e) {
      double x = random.normal();
      for (std::size_t i = part->first_row[e]; i < part->first_row[e + 1]; ++i)
        values.push_back(x = 0.8 * x + 0.6 * random.normal());
    }
    part->add({"hiss", "", values, {}});
  }
}

// Never recorded: a batch in blocks or by chance, and an oil temperature that follows it loosely.
void add_hidden(Laboratory& laboratory, Parts& parts, Random& random) {
  const double level[4] = {-1.2, 0.5, 1.1, -0.4};
  laboratory.numbers("hidden_block", [&](double p) { return level[block(p, 4)]; });
  laboratory.numbers("hidden_batch", [&](double) { return level[random.below(3)]; });
  for (const char* hidden : {"hidden_block", "hidden_batch"}) {
    const Values of = parts.training.per_test(hidden);
    for (Part* part : {&parts.training, &parts.validation}) {
      Values values = standardised(part->per_test(hidden), of);
      for (double& x : values)
        x = 40 + 2 * (0.6 * x + 0.8 * random.normal());
      part->add_per_test(std::string("oil_C of ") + hidden, values);
    }
  }
}

} // namespace

void add_bystanders(Parts& parts, Random& random) {
  for (Part* part : {&parts.training, &parts.validation})
    for (std::size_t e = 0; e < part->tests(); ++e)
      part->place.push_back(random.uniform());
  Laboratory laboratory(parts, random);
  add_order(laboratory, parts, random);
  add_independent(laboratory, random);
  add_correlated(parts, random);
  add_hiss(parts, random);
  add_hidden(laboratory, parts, random);
}

} // namespace frictab::foreign
