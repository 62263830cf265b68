// Makes bystanders of the synthetic campaign: the further columns of a log book.
#include "twin/twin_bystanders.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace frictab::twin {

namespace {

// Purpose of each random stream.
constexpr unsigned bystander_stream = 2;
constexpr unsigned humidity_stream = 3;
constexpr unsigned room_stream = 5;
constexpr unsigned more_stream = 6;

constexpr double film_mean = 8; // um
constexpr double film_scatter = 0.15;

// Draws the room climate by order of tests: an AR(1) over both parts.
std::vector<double> humidity_by_order(std::uint64_t seed, std::size_t tests) {
  Random random(seed, twin_stream(2, 0, humidity_stream));
  std::vector<double> humidity(tests);
  double state = random.normal();
  for (double& value : humidity) {
    value = round_to(std::clamp(45 + 8 * state, 5.0, 95.0), 1);
    state = 0.9 * state + std::sqrt(1 - 0.81) * random.normal();
  }
  return humidity;
}

void fill_constant(data::Column& column, std::size_t experiment, std::size_t points, double value) {
  std::fill_n(column.values.begin() + static_cast<std::ptrdiff_t>(experiment * points), points,
              value);
}

void fill_bystanders(std::uint64_t seed, std::size_t tests, TwinDraft& draft, std::size_t points) {
  const std::size_t rows = draft.plan.size() * points;
  const std::size_t first = draft.data.columns.size();
  for (const char* name : {"run_order", "humidity_pct", "film_um", "Ra_um", "tool"})
    add_column(draft.data, name, rows);
  draft.data.columns.back().levels = {"A", "B", "C"};
  const auto humidity = humidity_by_order(seed, tests);
  for (std::size_t e = 0; e < draft.plan.size(); ++e) {
    Random random(seed, twin_stream(draft.part, e, bystander_stream));
    const std::size_t order = draft.plan[e].run_order;
    const double film = round_to(film_mean * std::exp(film_scatter * random.normal()), 2);
    const double roughness = round_to(0.35 * std::exp(0.25 * random.normal()), 3);
    const double values[] = {static_cast<double>(order), humidity[order - 1], film, roughness,
                             static_cast<double>(random.below(3))};
    for (std::size_t c = 0; c < std::size(values); ++c)
      fill_constant(draft.data.columns[first + c], e, points, values[c]);
  }
}

// Draws the room temperature, which rises during the campaign.
std::vector<double> room_by_order(std::uint64_t seed, std::size_t tests) {
  Random random(seed, twin_stream(2, 0, room_stream));
  std::vector<double> room(tests);
  for (std::size_t i = 0; i < tests; ++i) {
    const double warmed = 7 * static_cast<double>(i) / static_cast<double>(tests);
    room[i] = round_to(18 + warmed + 0.5 * random.normal(), 1);
  }
  return room;
}

// Draws a second reading of the film, whose logarithm has correlation 0.9 with that of the first.
double second_film(double film, Random& random) {
  const double first = std::log(film / film_mean) / film_scatter;
  const double second = 0.9 * first + std::sqrt(1 - 0.81) * random.normal();
  return round_to(5 * std::exp(film_scatter * second), 2);
}

void fill_more(std::uint64_t seed, std::size_t tests, TwinDraft& draft, std::size_t points) {
  const std::size_t rows = draft.plan.size() * points;
  const std::vector<double> film = draft.data.find("film_um")->values;
  const std::size_t first = draft.data.columns.size();
  for (const char* name : {"film2_um", "lab_T_C", "dwell_s", "direction", "batch", "vib"})
    add_column(draft.data, name, rows);
  data::Column* const columns = draft.data.columns.data() + first;
  columns[3].levels = {"across", "along"};
  columns[4].levels = {"B1", "B2", "B3", "B4", "B5", "B6"};
  const auto room = room_by_order(seed, tests);
  for (std::size_t e = 0; e < draft.plan.size(); ++e) {
    Random random(seed, twin_stream(draft.part, e, more_stream));
    const std::size_t position = draft.plan[e].run_order - 1;
    fill_constant(columns[0], e, points, second_film(film[e * points], random));
    fill_constant(columns[1], e, points, room[position]);
    fill_constant(columns[2], e, points, round_to(std::pow(100, random.uniform()), 1));
    fill_constant(columns[3], e, points, static_cast<double>(random.below(2)));
    fill_constant(columns[4], e, points,
                  static_cast<double>(position * columns[4].levels.size() / tests));
    for (std::size_t i = e * points; i < (e + 1) * points; ++i)
      columns[5].values[i] = round_to(std::exp(0.3 * random.normal()), 3);
  }
}

} // namespace

void add_bystanders(const TwinOptions& options, std::size_t tests, TwinDraft& draft) {
  const std::size_t points = options.design->points;
  fill_bystanders(options.seed, tests, draft, points);
  if (options.more_bystanders) fill_more(options.seed, tests, draft, points);
}

} // namespace frictab::twin
