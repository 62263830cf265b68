// Designs, and the states of a test along time.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "foreign/part.h"

namespace frictab::foreign {

namespace {

constexpr double pi = std::numbers::pi;

// Levels of pressure, speed, tool temperature and surface expansion.
std::array<std::size_t, 4> levels_for(std::size_t tests) {
  if (tests == 12) return {3, 2, 2, 1};
  if (tests == 20) return {5, 2, 2, 1};
  if (tests == 24) return {4, 3, 2, 1};
  if (tests == 40) return {5, 4, 2, 1};
  return {3, 3, 3, 3};
}

// Where the count of tests is no product of the levels, a part of the design, drawn at random.
std::vector<Point> factorial(std::size_t tests, Random& random) {
  const auto levels = levels_for(tests);
  std::size_t all = 1;
  for (const std::size_t count : levels)
    all *= count;
  std::vector<std::size_t> cells(std::max(all, tests));
  for (std::size_t i = 0; i < cells.size(); ++i)
    cells[i] = i % all;
  if (tests != all) random.shuffle(std::span<std::size_t>(cells));
  std::vector<Point> points;
  for (std::size_t i = 0; i < tests; ++i) {
    Point point{};
    std::size_t cell = cells[i];
    for (std::size_t f = 0; f < 4; ++f) {
      const std::size_t level = cell % levels[f];
      cell /= levels[f];
      point[f] =
          levels[f] == 1 ? 0.5 : static_cast<double>(level) / static_cast<double>(levels[f] - 1);
    }
    points.push_back(point);
  }
  return points;
}

Point anywhere(Random& random) {
  Point point;
  for (double& x : point)
    x = random.uniform();
  return point;
}

std::vector<Point> one_factor(std::size_t tests, Random& random) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < tests; ++i) {
    Point point{0.5, 0.5, 0.5, 0.5};
    if (i % 9 != 0) point[i % 4] = random.uniform();
    points.push_back(point);
  }
  return points;
}

std::vector<Point> clustered(std::size_t tests, Random& random) {
  std::vector<Point> centres(3 + random.below(3));
  for (Point& centre : centres)
    centre = anywhere(random);
  std::vector<Point> points;
  for (std::size_t i = 0; i < tests; ++i) {
    Point point = centres[i % centres.size()];
    for (double& x : point)
      x = std::clamp(x + 0.04 * random.normal(), 0.0, 1.0);
    points.push_back(point);
  }
  return points;
}

} // namespace

std::vector<std::string> design_kinds() {
  return {"factorial", "random", "one_factor", "clustered"};
}

std::vector<Point> design(const Options& options, Random& random) {
  if (options.design == "factorial") return factorial(options.tests, random);
  if (options.design == "one_factor") return one_factor(options.tests, random);
  if (options.design == "clustered") return clustered(options.tests, random);
  if (options.design != "random") throw std::invalid_argument("design " + options.design);
  std::vector<Point> points(options.tests);
  for (Point& point : points)
    point = anywhere(random);
  return points;
}

// Anywhere in the ranges; a level that no training test varies stays where it was.
std::vector<Point> held_out_points(const std::vector<Point>& training, std::size_t count,
                                   Random& random) {
  std::vector<Point> points(count);
  for (Point& point : points) {
    point = anywhere(random);
    for (std::size_t f = 0; f < point.size(); ++f)
      if (std::all_of(training.begin(), training.end(),
                      [&](const Point& p) { return p[f] == training[0][f]; }))
        point[f] = training[0][f];
  }
  return points;
}

std::size_t rows_of_a_test(const std::string& kind, Random& random) {
  const auto between = [&](double low, double high) {
    return static_cast<std::size_t>(std::lround(low * std::pow(high / low, random.uniform())));
  };
  if (kind == "one") return 1;
  if (kind == "few") return 4 + random.below(9);
  if (kind == "equal") return 60;
  if (kind == "many") return 200;
  if (kind == "unequal") return between(10, 500);
  if (kind == "wild") return between(1, 2000);
  throw std::invalid_argument("rows " + kind);
}

Program draw_program(const std::string& effect, Random& random) {
  Program program;
  program.pressure = static_cast<int>(random.below(6));
  program.speed = static_cast<int>(random.below(6));
  program.heat = random.uniform(0.002, 0.006);
  program.settle_s = random.uniform(0.2, 3);
  program.psi_power = random.uniform(0.6, 2);
  program.hardens = random.below(2) == 0;
  program.hardening = random.uniform(0.12, 0.25);
  program.yield_MPa = program.hardens ? random.uniform(850, 1000) : random.uniform(700, 1000);
  // Whoever looks for an effect of unloading has unloaded.
  const bool unloads = effect.find("unloading") != std::string::npos ||
                       effect.find("pressure peak") != std::string::npos;
  if (unloads) program.pressure = 2 + static_cast<int>(random.below(3));
  return program;
}

namespace {

double pressure_at(int kind, double u, double phase) {
  switch (kind) {
  case 0:
    return 0.35 + 0.65 * std::pow(u, 0.5 + phase);
  case 1:
    return 1 - 0.65 * u;
  case 2:
    return 0.5 + 0.5 * std::abs(std::sin(pi * (3 * u + phase)));
  case 3:
    return 0.65 + 0.35 * std::sin(2 * pi * ((1.5 + phase) * u + phase));
  default:
    return 0.25 + 0.75 * std::sin(pi * std::pow(u, 0.7 + 0.8 * phase));
  }
}

double speed_at(int kind, double u, double phase) {
  switch (kind) {
  case 0:
    return 0.3 + 0.9 * u;
  case 1:
    return 1.2 - 0.9 * u;
  case 2:
    return 1 + 0.5 * std::sin(2 * pi * (2 * u + phase));
  case 3:
    return u < 0.3 + 0.4 * phase ? 0.6 : 1.3;
  default:
    return 1 + 0.03 * std::sin(11 * u + phase);
  }
}

// States along a fine time axis; a recorder takes some of its points.
struct Course {
  Values time_s, sigma, psi, speed, temperature, distance, flow_stress;
};

Course course_of(const Program& program, const Point& point, std::size_t steps, Random& random) {
  const int pressure = program.pressure == 5 ? static_cast<int>(random.below(5)) : program.pressure;
  const int speed = program.speed == 5 ? static_cast<int>(random.below(5)) : program.speed;
  const double phase = random.uniform(), other_phase = random.uniform();
  const double duration = 0.5 * std::pow(16, random.uniform());
  const double top = 500 * std::pow(5, point[0]), v = 5 * std::pow(60, point[1]);
  const double tool = 20 + 180 * point[2], psi_end = 1.2 * std::pow(10, point[3]);
  const double dt = duration / static_cast<double>(steps - 1);
  Course course;
  double temperature = tool, distance = 0;
  for (std::size_t i = 0; i < steps; ++i) {
    const double u = static_cast<double>(i) / static_cast<double>(steps - 1);
    course.time_s.push_back(u * duration);
    course.sigma.push_back(top * pressure_at(pressure, u, phase));
    course.speed.push_back(v * speed_at(speed, u, other_phase));
    course.psi.push_back(1 + (psi_end - 1) * std::pow(u, program.psi_power));
    const double rise = program.heat * course.sigma.back() * std::sqrt(course.speed.back());
    if (i > 0) {
      temperature += (tool + rise - temperature) * -std::expm1(-dt / program.settle_s);
      distance += 0.5 * dt * (course.speed[i] + course.speed[i - 1]);
    }
    course.temperature.push_back(temperature);
    course.distance.push_back(distance);
    const double strain = 0.05 + std::log(course.psi.back());
    course.flow_stress.push_back(program.yield_MPa *
                                 (program.hardens ? std::pow(strain, program.hardening) : 1.0));
  }
  return course;
}

} // namespace

void simulate(Part& part, const Program& program, const Point& point, std::size_t rows,
              Random& random) {
  const std::size_t steps = std::max<std::size_t>(300, rows);
  const Course course = course_of(program, point, steps, random);
  const std::size_t alone = steps / 2 + random.below(steps / 2);
  const std::pair<const char*, const Values*> recorded[] = {{"time_s", &course.time_s},
                                                            {"sigma_n_MPa", &course.sigma},
                                                            {"psi", &course.psi},
                                                            {"v_rel_mm_s", &course.speed},
                                                            {"T_contact_C", &course.temperature},
                                                            {"s_mm", &course.distance},
                                                            {"sigma_f_MPa", &course.flow_stress}};
  const bool first = part.columns.empty();
  for (const auto& [name, values] : recorded) {
    if (first) part.add({name, "", {}, {}});
    Values& column =
        std::find_if(part.columns.begin(), part.columns.end(), [&](const data::Column& c) {
          return c.name == name;
        })->values;
    for (std::size_t r = 0; r < rows; ++r)
      column.push_back((*values)[rows == 1 ? alone : r * (steps - 1) / (rows - 1)]);
  }
  part.first_row.push_back(part.rows() + rows);
}

} // namespace frictab::foreign
