// Causes in the states and their histories. Each gives the exponent of a factor on friction.
#include <algorithm>
#include <cmath>

#include "foreign/shapes.h"

namespace frictab::foreign {

namespace {

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

Shape stick_slip(const Part& training, Random& random) {
  const double from = somewhere(training.at("v_rel_mm_s"), 0.3, 0.5, random);
  const double to = somewhere(training.at("v_rel_mm_s"), 0.6, 0.75, random);
  return [=](const Part& part) {
    const Values& v = part.at("v_rel_mm_s");
    return by_row(part, [&](std::size_t i) { return v[i] > from && v[i] < to ? 1.0 : 0.0; });
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

using Answers = std::vector<std::vector<std::string>>;
const Answers before_and_after = {{"sigma_n_MPa", "peak_sigma_n"},
                                  {"sigma_n_MPa", "mean_sigma_n"},
                                  {"peak_sigma_n"},
                                  {"mean_sigma_n"},
                                  {"load_ratio"},
                                  {"load_direction"},
                                  {"slip_since_peak"},
                                  {"sigma_n_MPa", "dwell"},
                                  {"sigma_n_MPa", "time_s"}};
const Answers history = {{"energy"}, {"friction_work"}};

} // namespace

const std::vector<EffectKind>& effects_of_states() {
  static const std::vector<EffectKind> all = {
      {"lower while unloading", before_and_after, true, unloading},
      {"work threshold", history, true, work_threshold},
      {"product of three states",
       {{"sigma_n_MPa", "v_rel_mm_s", "T_contact_C"}, {"friction_power", "T_contact_C"}},
       false,
       product_of_three},
      {"breakdown at psi and T", {{"psi", "T_contact_C"}}, false, breakdown},
      {"stick-slip band", {{"v_rel_mm_s"}}, false, stick_slip},
      {"late rise", {{"s_mm"}, {"energy"}, {"friction_work"}}, true, late_rise},
      {"lagged temperature",
       {{"T_contact_C"},
        {"mean_T_contact"},
        {"peak_T_contact"},
        {"temperature_lag"},
        {"temperature_rise"}},
       true,
       lagged_temperature},
      {"flash temperature",
       {{"sigma_n_MPa", "v_rel_mm_s"}, {"friction_power"}, {"flash_heating"}},
       false,
       flash_temperature},
      {"saturates with energy", history, true, energy_saturates},
      {"before the pressure peak", before_and_after, true, before_the_peak},
      {"speed weakening", {{"v_rel_mm_s"}}, false, speed_weakening},
      {"contact above tool temperature",
       {{"T_contact_C", "T_tool_C"}, {"temperature_above_tool"}},
       false,
       above_the_tool},
      {"fresh surface", {{"psi", "s_mm"}, {"psi", "time_s"}}, true, fresh_surface},
  };
  return all;
}

} // namespace frictab::foreign
