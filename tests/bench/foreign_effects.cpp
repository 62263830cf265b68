// Causes that friction follows beside the base law. Each gives the exponent of a factor on
// friction.
#include <algorithm>
#include <cmath>

#include "bench/foreign_part.h"

namespace frictab::foreign {

namespace {

// Along every test on its own: f(first row, row behind the last, output).
template <class Along> Values by_test(const Part& part, Along along) {
  Values out(part.rows());
  for (std::size_t e = 0; e < part.tests(); ++e)
    along(part.first_row[e], part.first_row[e + 1], out);
  return out;
}

template <class Of> Values by_row(const Part& part, Of of) {
  Values out(part.rows());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = of(i);
  return out;
}

Values integral(const Part& part, const Values& of) {
  const Values& s = part.at("s_mm");
  return by_test(part, [&](std::size_t first, std::size_t end, Values& out) {
    for (std::size_t i = first + 1; i < end; ++i)
      out[i] = out[i - 1] + 0.5 * (of[i] + of[i - 1]) * (s[i] - s[i - 1]);
  });
}

// A level between the shares low and high of the training rows.
double somewhere(const Values& values, double low, double high, Random& random) {
  return quantile(values, random.uniform(low, high));
}

double sign(Random& random) {
  return random.below(2) == 0 ? -1 : 1;
}

// Friction is lower while the load falls.
Shape unloading(const Part&, Random&) {
  return [](const Part& part) {
    const Values& sigma = part.at("sigma_n_MPa");
    return by_test(part, [&](std::size_t first, std::size_t end, Values& out) {
      for (std::size_t i = first + 1; i < end; ++i)
        out[i] = sigma[i] < sigma[i - 1] ? -1 : 0;
    });
  };
}

Shape work_threshold(const Part& training, Random& random) {
  const Values work = integral(training, training.law);
  const double from = somewhere(work, 0.4, 0.75, random), s = sign(random);
  return [=](const Part& part) {
    Values out = integral(part, part.law);
    for (double& x : out)
      x = x > from ? s : 0;
    return out;
  };
}

Shape product_of_three(const Part& training, Random& random) {
  const Values &a = training.at("sigma_n_MPa"), &b = training.at("v_rel_mm_s"),
               &c = training.at("T_contact_C");
  const double s = sign(random);
  const double a0 = quantile(a, 0.95), b0 = quantile(b, 0.95), c0 = quantile(c, 0.95);
  return [=](const Part& part) {
    const Values &x = part.at("sigma_n_MPa"), &y = part.at("v_rel_mm_s"),
                 &z = part.at("T_contact_C");
    return by_row(part, [&](std::size_t i) { return s * x[i] / a0 * (y[i] / b0) * (z[i] / c0); });
  };
}

// The film breaks down where psi and T together pass a line.
Shape breakdown(const Part& training, Random& random) {
  const double psi0 = quantile(training.at("psi"), 0.9);
  const double t0 = quantile(training.at("T_contact_C"), 0.9);
  const auto load = [=](const Part& part) {
    const Values &psi = part.at("psi"), &t = part.at("T_contact_C");
    return by_row(part, [&](std::size_t i) { return psi[i] / psi0 + t[i] / t0; });
  };
  const double line = somewhere(load(training), 0.5, 0.75, random);
  return [=](const Part& part) {
    Values out = load(part);
    for (double& x : out)
      x = 1 / (1 + std::exp(-(x - line) / 0.05));
    return out;
  };
}

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

Shape stick_slip(const Part& training, Random& random) {
  const double from = somewhere(training.at("v_rel_mm_s"), 0.3, 0.5, random);
  const double to = somewhere(training.at("v_rel_mm_s"), 0.6, 0.75, random);
  return [=](const Part& part) {
    const Values& v = part.at("v_rel_mm_s");
    return by_row(part, [&](std::size_t i) { return v[i] > from && v[i] < to ? 1.0 : 0.0; });
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

Shape late_rise(const Part& training, Random& random) {
  const double from = somewhere(training.at("s_mm"), 0.5, 0.8, random);
  const double top = quantile(training.at("s_mm"), 0.98);
  return [=](const Part& part) {
    const Values& distance = part.at("s_mm");
    return by_row(part, [&](std::size_t i) {
      const double x = std::clamp((distance[i] - from) / (top - from), 0.0, 1.5);
      return x * x;
    });
  };
}

// The film follows the temperature late.
Shape lagged_temperature(const Part&, Random& random) {
  const double lag = random.uniform(0.5, 2.5), s = sign(random);
  return [=](const Part& part) {
    const Values &t = part.at("time_s"), &temperature = part.at("T_contact_C");
    return by_test(part, [&](std::size_t first, std::size_t end, Values& out) {
      double film = temperature[first];
      for (std::size_t i = first; i < end; ++i) {
        if (i > first) film += (temperature[i] - film) * -std::expm1(-(t[i] - t[i - 1]) / lag);
        out[i] = s * film / 100;
      }
    });
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

Shape flash_temperature(const Part& training, Random&) {
  const auto flash = [](const Part& part) {
    const Values &sigma = part.at("sigma_n_MPa"), &v = part.at("v_rel_mm_s");
    return by_row(part, [&](std::size_t i) { return sigma[i] * std::sqrt(v[i]); });
  };
  const double top = quantile(flash(training), 0.9);
  return [=](const Part& part) {
    Values out = flash(part);
    for (double& x : out)
      x = -std::pow(x / top, 1.5);
    return out;
  };
}

Shape energy_saturates(const Part& training, Random& random) {
  const double to = somewhere(integral(training, training.at("sigma_n_MPa")), 0.2, 0.5, random);
  const double s = sign(random);
  return [=](const Part& part) {
    Values out = integral(part, part.at("sigma_n_MPa"));
    for (double& x : out)
      x = s * -std::expm1(-x / to);
    return out;
  };
}

Shape before_the_peak(const Part&, Random& random) {
  const double s = sign(random);
  return [=](const Part& part) {
    const Values& sigma = part.at("sigma_n_MPa");
    return by_test(part, [&](std::size_t first, std::size_t end, Values& out) {
      const auto begin = sigma.begin();
      const auto peak = std::max_element(begin + static_cast<std::ptrdiff_t>(first),
                                         begin + static_cast<std::ptrdiff_t>(end));
      for (std::size_t i = first; i < static_cast<std::size_t>(peak - begin); ++i)
        out[i] = s;
    });
  };
}

Shape speed_weakening(const Part& training, Random& random) {
  const double v0 = somewhere(training.at("v_rel_mm_s"), 0.4, 0.7, random);
  return [=](const Part& part) {
    const Values& v = part.at("v_rel_mm_s");
    return by_row(part, [&](std::size_t i) { return 1 / (1 + std::pow(v[i] / v0, 2)); });
  };
}

Shape above_the_tool(const Part& training, Random& random) {
  const auto rise = [](const Part& part) {
    const Values &t = part.at("T_contact_C"), &tool = part.at("T_tool_C");
    return by_row(part, [&](std::size_t i) { return t[i] - tool[i]; });
  };
  const double top = std::max(1.0, quantile(rise(training), 0.9)), s = sign(random);
  return [=](const Part& part) {
    Values out = rise(part);
    for (double& x : out)
      x *= s / top;
    return out;
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

// Fresh surface per slip.
Shape fresh_surface(const Part& training, Random& random) {
  const auto rate = [](const Part& part) {
    const Values &psi = part.at("psi"), &s = part.at("s_mm");
    return by_row(part, [&](std::size_t i) { return (psi[i] - 1) / (s[i] + 5); });
  };
  const double top = quantile(rate(training), 0.9), s = sign(random);
  return [=](const Part& part) {
    Values out = rate(part);
    for (double& x : out)
      x = s * std::min(x / top, 2.0);
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

template <int which> Shape hidden(const Part&, Random& random) {
  const double s = sign(random);
  return [=](const Part& part) {
    Values out = part.at(which == 0 ? "hidden_block" : "hidden_batch");
    for (double& x : out)
      x *= s;
    return out;
  };
}

using Answers = std::vector<std::vector<std::string>>;
const Answers before_and_after = {{"sigma_n_MPa", "peak_sigma_n"},
                                  {"sigma_n_MPa", "mean_sigma_n"},
                                  {"peak_sigma_n"},
                                  {"mean_sigma_n"},
                                  {"sigma_n_MPa", "dwell"},
                                  {"sigma_n_MPa", "time_s"}};
const Answers history = {{"energy"}, {"friction_work"}};

} // namespace

const std::vector<EffectKind>& effects() {
  static const std::vector<EffectKind> all = {
      {"lower while unloading", before_and_after, true, unloading},
      {"work threshold", history, true, work_threshold},
      {"product of three states",
       {{"sigma_n_MPa", "v_rel_mm_s", "T_contact_C"}, {"friction_power", "T_contact_C"}},
       false,
       product_of_three},
      {"breakdown at psi and T", {{"psi", "T_contact_C"}}, false, breakdown},
      {"recovery in a pause",
       {{"pause_s", "s_mm"}, {"pause_s", "energy"}, {"pause_s", "friction_work"}},
       true,
       recovery},
      {"roughness in one lot", {{"Ra_um", "lot"}}, false, rough_in_one_lot},
      {"tool by temperature",
       {{"tool", "T_contact_C"}, {"tool", "T_tool_C"}},
       false,
       tool_by_temperature},
      {"stick-slip band", {{"v_rel_mm_s"}}, false, stick_slip},
      {"carry-over of a pause", {{"pause_s"}}, false, carry_over},
      {"late rise", {{"s_mm"}, {"energy"}, {"friction_work"}}, true, late_rise},
      {"lagged temperature",
       {{"T_contact_C"}, {"mean_T_contact"}, {"peak_T_contact"}},
       true,
       lagged_temperature},
      {"U-shape of roughness", {{"Ra_um"}}, false, u_shape},
      {"threshold of the film", {{"lube_g_m2"}}, false, lube_threshold},
      {"levels of an additive", {{"additive"}}, false, additive_levels},
      {"humidity power", {{"humidity_pct"}}, false, humidity_power},
      {"flash temperature",
       {{"sigma_n_MPa", "v_rel_mm_s"}, {"friction_power"}},
       false,
       flash_temperature},
      {"saturates with energy", history, true, energy_saturates},
      {"before the pressure peak", before_and_after, true, before_the_peak},
      {"speed weakening", {{"v_rel_mm_s"}}, false, speed_weakening},
      {"contact above tool temperature", {{"T_contact_C", "T_tool_C"}}, false, above_the_tool},
      {"one lot", {{"lot"}}, false, one_lot},
      {"cleaned tool", {{"cleaned"}}, false, cleaned},
      {"fresh surface", {{"psi", "s_mm"}, {"psi", "time_s"}}, true, fresh_surface},
      {"dry air on a thin film", {{"humidity_pct", "lube_g_m2"}}, false, dry_and_thin},
      {"damp start",
       {{"humidity_pct", "s_mm"}, {"humidity_pct", "energy"}, {"humidity_pct", "friction_work"}},
       true,
       damp_start},
  };
  return all;
}

const std::vector<EffectKind>& hidden_effects() {
  static const std::vector<EffectKind> all = {
      {"hidden batch in blocks", {}, false, hidden<0>},
      {"hidden batch by chance", {}, false, hidden<1>},
      {"hidden batch without a trace", {}, false, hidden<1>},
  };
  return all;
}

const EffectKind* find_kind(const std::string& name) {
  for (const auto* list : {&effects(), &hidden_effects()})
    for (const EffectKind& kind : *list)
      if (kind.name == name) return &kind;
  return nullptr;
}

std::vector<std::string> effect_kinds() {
  std::vector<std::string> names;
  for (const EffectKind& kind : effects())
    names.push_back(kind.name);
  return names;
}

std::vector<std::string> hidden_kinds() {
  std::vector<std::string> names;
  for (const EffectKind& kind : hidden_effects())
    names.push_back(kind.name);
  return names;
}

bool within_tests(const std::string& effect) {
  const EffectKind* kind = find_kind(effect);
  return kind != nullptr && kind->within;
}

} // namespace frictab::foreign
