// Causes in recorded columns that no law uses, alone or with a state. Each gives the exponent of a
// factor on friction.
#include <algorithm>
#include <cmath>

#include "foreign/shapes.h"

namespace frictab::foreign {

namespace {

// What a pause leaves behind is slid away.
Shape recovery(const Part& training, Random& random) {
  const double length = somewhere(training.at("s_mm"), 0.2, 0.5, random), s = sign(random);
  return [=](const Part& part) {
    const Values &pause = part.at("pause_s"), &distance = part.at("s_mm");
    return by_row(part, [&](std::size_t i) {
      return s * std::log1p(pause[i] / 60) * std::exp(-distance[i] / length);
    });
  };
}

Shape rough_in_one_lot(const Part&, Random& random) {
  const double s = sign(random);
  return [=](const Part& part) {
    const Values &lot = part.at("lot"), &rough = part.at("Ra_um");
    return by_row(part, [&](std::size_t i) { return lot[i] == 1 ? s * (rough[i] - 0.2) : 0.0; });
  };
}

Shape tool_by_temperature(const Part&, Random& random) {
  const double s = sign(random);
  return [=](const Part& part) {
    const Values &tool = part.at("tool"), &t = part.at("T_contact_C");
    return by_row(part, [&](std::size_t i) { return tool[i] == 1 ? s * t[i] / 200 : 0.0; });
  };
}

// A short pause leaves the heat of the test before.
Shape carry_over(const Part& training, Random& random) {
  const double fades = somewhere(training.at("pause_s"), 0.3, 0.7, random), s = sign(random);
  return [=](const Part& part) {
    const Values& pause = part.at("pause_s");
    return by_row(part, [&](std::size_t i) { return s * std::exp(-pause[i] / fades); });
  };
}

Shape u_shape(const Part& training, Random& random) {
  const double middle = somewhere(training.per_test("Ra_um"), 0.4, 0.6, random);
  return [=](const Part& part) {
    const Values& rough = part.at("Ra_um");
    return by_row(part, [&](std::size_t i) {
      const double x = std::log(rough[i] / middle);
      return x * x;
    });
  };
}

Shape lube_threshold(const Part& training, Random& random) {
  const double least = somewhere(training.per_test("lube_g_m2"), 0.3, 0.7, random);
  return [=](const Part& part) {
    const Values& lube = part.at("lube_g_m2");
    return by_row(part, [&](std::size_t i) { return lube[i] < least ? 1.0 : 0.0; });
  };
}

Shape additive_levels(const Part&, Random& random) {
  std::array<double, 4> level{0, random.uniform(-0.6, 0.2), random.uniform(-1, -0.4),
                              random.uniform(-0.9, 0.3)};
  return [=](const Part& part) {
    const Values& additive = part.at("additive");
    return by_row(part,
                  [&](std::size_t i) { return level[static_cast<std::size_t>(additive[i])]; });
  };
}

Shape humidity_power(const Part&, Random& random) {
  const double s = sign(random);
  return [=](const Part& part) {
    const Values& humidity = part.at("humidity_pct");
    return by_row(part, [&](std::size_t i) { return s * std::log(humidity[i] / 50); });
  };
}

Shape one_lot(const Part&, Random& random) {
  const double s = sign(random);
  return [=](const Part& part) {
    const Values& lot = part.at("lot");
    return by_row(part, [&](std::size_t i) { return lot[i] == 0 ? s : 0.0; });
  };
}

Shape cleaned(const Part&, Random& random) {
  const double s = sign(random);
  return [=](const Part& part) {
    Values out = part.at("cleaned");
    for (double& x : out)
      x *= s;
    return out;
  };
}

// Only dry air on a thin film.
Shape dry_and_thin(const Part&, Random&) {
  return [](const Part& part) {
    const Values &humidity = part.at("humidity_pct"), &lube = part.at("lube_g_m2");
    return by_row(part, [&](std::size_t i) {
      return std::max(0.0, 55 - humidity[i]) / 30 * std::max(0.0, 11 - lube[i]) / 6;
    });
  };
}

// Grows with the humidity, and only while there is little slip behind it.
Shape damp_start(const Part& training, Random& random) {
  const double length = somewhere(training.at("s_mm"), 0.2, 0.4, random);
  return [=](const Part& part) {
    const Values &humidity = part.at("humidity_pct"), &s = part.at("s_mm");
    return by_row(part,
                  [&](std::size_t i) { return s[i] < length ? (humidity[i] - 25) / 50 : 0.0; });
  };
}

} // namespace

const std::vector<EffectKind>& effects_of_bystanders() {
  static const std::vector<EffectKind> all = {
      {"recovery in a pause",
       {{"pause_s", "s_mm"}, {"pause_s", "energy"}, {"pause_s", "friction_work"}},
       true,
       recovery},
      {"roughness in one lot", {{"Ra_um", "lot"}}, false, rough_in_one_lot},
      {"tool by temperature",
       {{"tool", "T_contact_C"}, {"tool", "T_tool_C"}},
       false,
       tool_by_temperature},
      {"carry-over of a pause", {{"pause_s"}}, false, carry_over},
      {"U-shape of roughness", {{"Ra_um"}}, false, u_shape},
      {"threshold of the film", {{"lube_g_m2"}}, false, lube_threshold},
      {"levels of an additive", {{"additive"}}, false, additive_levels},
      {"humidity power", {{"humidity_pct"}}, false, humidity_power},
      {"one lot", {{"lot"}}, false, one_lot},
      {"cleaned tool", {{"cleaned"}}, false, cleaned},
      {"dry air on a thin film", {{"humidity_pct", "lube_g_m2"}}, false, dry_and_thin},
      {"damp start",
       {{"humidity_pct", "s_mm"}, {"humidity_pct", "energy"}, {"humidity_pct", "friction_work"}},
       true,
       damp_start},
  };
  return all;
}

} // namespace frictab::foreign
