// Compares the states of a process with those of the tests, weighted by friction work.
#include "process/coverage.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

#include "core/parallel.h"
#include "data/condense.h"
#include "data/quantity.h"
#include "table/distance.h"

namespace frictab::process {

namespace {

constexpr const char* joint_states[] = {"sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C"};
constexpr const char* further_states[] = {"s_mm", "sigma_f_MPa"};

struct Weights {
  std::span<const double> work;
  std::vector<double> contact;
  double all_work = 0, all_contact = 0;
};

Weights weights_of(const ContactHistory& h, std::span<const double> work_J) {
  Weights w{work_J, {}};
  for (std::size_t row = 0; row < h.rows(); ++row)
    w.contact.push_back(h.area_mm2[row] * h.dt_s[row]);
  w.all_work = std::accumulate(work_J.begin(), work_J.end(), 0.0);
  w.all_contact = std::accumulate(w.contact.begin(), w.contact.end(), 0.0);
  return w;
}

template <class Test> Share share_of(const Weights& w, const Test& counts) {
  Share share;
  for (std::size_t row = 0; row < w.work.size(); ++row)
    if (counts(row)) {
      share.work += w.work[row];
      share.contact += w.contact[row];
    }
  if (w.all_work > 0) share.work /= w.all_work;
  if (w.all_contact > 0) share.contact /= w.all_contact;
  return share;
}

// An axis of table/distance.h over a state of the tests.
table::TableAxis axis_of(const std::string& name) {
  table::TableAxis axis;
  axis.name = name;
  axis.log = data::find_quantity(name)->log_axis;
  axis.nodes = {0, 1}; // of no table
  return axis;
}

std::vector<double> distances(const ContactHistory& h, const std::vector<std::string>& names,
                              const data::Dataset& tests) {
  std::vector<table::TableAxis> axes;
  std::vector<std::span<const double>> of_tests, here;
  for (const std::string& name : names) {
    axes.push_back(axis_of(name));
    of_tests.push_back(tests.values(name));
    here.push_back(h.states.values(name));
  }
  const table::TestRows rows(axes, of_tests, tests.first_row);
  std::vector<double> found(h.rows());
  constexpr std::size_t block = 256;
  parallel_for((found.size() + block - 1) / block, [&](std::size_t b) {
    std::vector<double> state(names.size());
    for (std::size_t row = b * block; row < std::min(found.size(), (b + 1) * block); ++row) {
      for (std::size_t a = 0; a < state.size(); ++a)
        state[a] = here[a][row];
      found[row] = rows.distance(state);
    }
  });
  return found;
}

StateCoverage state_coverage(const ContactHistory& h, const Weights& w, const std::string& name,
                             const data::Dataset& tests) {
  StateCoverage c{name, data::find_quantity(name)->unit};
  const auto here = h.states.values(name);
  std::tie(c.tested_low, c.tested_high) = data::source_range(tests, name, tests.values(name));
  c.low = weighted_quantile(here, w.work, 0.01);
  c.median = weighted_quantile(here, w.work, 0.5);
  c.high = weighted_quantile(here, w.work, 0.99);
  c.below = share_of(w, [&](std::size_t row) { return here[row] < c.tested_low; });
  c.above = share_of(w, [&](std::size_t row) { return here[row] > c.tested_high; });
  return c;
}

bool is_held(const ContactHistory& h, const std::string& name) {
  return std::ranges::any_of(h.held, [&](const Held& held) { return held.state == name; });
}

PartCoverage part_coverage(std::string name, const Weights& w, const std::vector<char>& inside,
                           const std::vector<char>& outside, const std::vector<char>& thin) {
  PartCoverage part{std::move(name)};
  double work = 0;
  for (std::size_t row = 0; row < inside.size(); ++row)
    if (inside[row]) {
      work += w.work[row];
      part.outside += outside[row] ? w.work[row] : 0;
      part.thin += thin[row] ? w.work[row] : 0;
    }
  if (work > 0) {
    part.outside /= work;
    part.thin /= work;
  }
  part.share = w.all_work > 0 ? work / w.all_work : 0;
  return part;
}

} // namespace

std::vector<std::size_t> drawn_by_work(std::span<const double> work_J, std::size_t count) {
  const double all = std::accumulate(work_J.begin(), work_J.end(), 0.0);
  std::vector<std::size_t> rows;
  double sum = 0;
  for (std::size_t row = 0; row < work_J.size(); ++row) {
    sum += work_J[row];
    while (rows.size() < count &&
           sum >= (static_cast<double>(rows.size()) + 0.5) / static_cast<double>(count) * all)
      rows.push_back(row);
  }
  return rows;
}

double weighted_quantile(std::span<const double> values, std::span<const double> weights,
                         double share) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    return std::pair(values[a], a) < std::pair(values[b], b);
  });
  const double wanted = share * std::accumulate(weights.begin(), weights.end(), 0.0);
  double sum = 0;
  for (const std::size_t i : order) {
    sum += weights[i];
    if (sum >= wanted) return values[i];
  }
  return order.empty() ? 0 : values[order.back()];
}

Coverage coverage_of(const ContactHistory& h, std::span<const double> work_J,
                     const data::Dataset& tests) {
  const Weights w = weights_of(h, work_J);
  Coverage c;
  std::vector<std::string> joint;
  for (const char* name : joint_states) {
    if (!tests.has(name) || !h.states.has(name) || is_held(h, name)) continue;
    const auto [low, high] = data::source_range(tests, name, tests.values(name));
    if (low < high) joint.emplace_back(name);
  }
  std::vector<char> outside(h.rows()), thin(h.rows());
  for (const std::string& name : joint) {
    StateCoverage state = state_coverage(h, w, name, tests);
    const auto here = h.states.values(name);
    const std::vector<double> far = distances(h, {name}, tests);
    state.thin = share_of(w, [&](std::size_t row) { return far[row] > table::far_from_tests; });
    for (std::size_t row = 0; row < h.rows(); ++row)
      if (here[row] < state.tested_low || here[row] > state.tested_high) outside[row] = 1;
    c.states.push_back(std::move(state));
  }
  for (const char* name : further_states)
    if (tests.has(name) && h.states.has(name) && !is_held(h, name))
      c.further.push_back(state_coverage(h, w, name, tests));
  if (!joint.empty()) c.distance = distances(h, joint, tests);
  for (std::size_t row = 0; row < c.distance.size(); ++row)
    thin[row] = c.distance[row] > table::far_from_tests;
  c.outside = share_of(w, [&](std::size_t row) { return outside[row] != 0; });
  c.thin = share_of(w, [&](std::size_t row) { return thin[row] != 0; });
  const char* const thirds[] = {"first third", "second third", "last third"};
  const double whole = h.time_s.back() - h.start_s;
  for (int third = 0; third < 3; ++third) {
    std::vector<char> inside(h.rows());
    for (std::size_t row = 0; row < h.rows(); ++row) {
      const double at = 3 * (h.time_s[h.increment[row]] - h.start_s) / whole;
      inside[row] = std::clamp(static_cast<int>(std::ceil(at)) - 1, 0, 2) == third;
    }
    c.stroke.push_back(part_coverage(thirds[third], w, inside, outside, thin));
  }
  if (h.place_mm.empty()) return c;
  std::vector<double> edges;
  for (const double share : {0.0, 1.0 / 3, 2.0 / 3, 1.0})
    edges.push_back(weighted_quantile(h.place_mm, w.work, share));
  for (std::size_t third = 0; third < 3; ++third) {
    std::vector<char> inside(h.rows());
    for (std::size_t row = 0; row < h.rows(); ++row)
      inside[row] = (third == 0 || h.place_mm[row] > edges[third]) &&
                    (third == 2 || h.place_mm[row] <= edges[third + 1]);
    c.surface.push_back(part_coverage(
        fmt::format("{} {:.4g} to {:.4g} mm", h.place_name, edges[third], edges[third + 1]), w,
        inside, outside, thin));
  }
  return c;
}

} // namespace frictab::process
