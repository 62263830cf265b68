// Interpolation in five axes, ns per query: value, and value with all derivatives, each beside a
// plain nested loop over the same nodes in the same run (argument: the size of the table).
#include <benchmark/benchmark.h>

#include "core/random.h"
#include "table/frictab_kernel.h"
// The two that stand behind it.
#include "table/frictab_cubic.h"
#include "table/frictab_gradient.h"
#include "table/spline.h"

namespace frictab {
namespace {

constexpr int axes = 5;
constexpr std::size_t queries = 4096;

// 0: 4,800 nodes, as neural_network needs at 0.5 MPa; 1: 210,681 nodes, larger than the L2 cache.
struct Grid {
  explicit Grid(std::int64_t size, bool even) {
    const std::vector<std::size_t> counts = size == 0 ? std::vector<std::size_t>{6, 4, 5, 5, 8}
                                                      : std::vector<std::size_t>{17, 9, 9, 9, 17};
    std::size_t nodes = 1;
    for (const std::size_t count : counts) {
      std::vector<double> x;
      for (std::size_t i = 0; i < count; ++i) {
        const double w = static_cast<double>(i) / static_cast<double>(count - 1);
        x.push_back(even ? w : 0.5 * w * (1 + w));
      }
      splines.push_back(spline_axis(x));
      nodes *= count;
    }
    Random random(1);
    for (std::size_t i = 0; i < nodes; ++i)
      value.push_back(random.uniform(1, 2));
    coefficients = spline_coefficients(splines, value);
    for (const SplineAxis& spline : splines) {
      const int n = static_cast<int>(spline.u.size());
      linear.push_back({n, even ? n - 1.0 : 0, spline.u.data()});
      cubic.push_back({linear.back(), spline.first.data(), spline.basis.data()});
    }
    for (std::size_t i = 0; i < queries * axes; ++i)
      u.push_back(random.uniform());
  }
  std::vector<SplineAxis> splines;
  std::vector<ft_axis> linear;
  std::vector<ft_spline_axis> cubic;
  std::vector<double> value, coefficients, u;
};

// The cell by a walk from the left, weights, then the sum as it stands in a textbook.
double nested(const Grid& grid, const double* u, int taps) {
  int first[axes];
  double w[axes][4];
  for (int d = 0; d < axes; ++d) {
    const ft_axis& axis = grid.linear[static_cast<std::size_t>(d)];
    int cell = 0;
    while (cell < axis.n - 2 && axis.u[cell + 1] <= u[d])
      ++cell;
    const double t = (u[d] - axis.u[cell]) / (axis.u[cell + 1] - axis.u[cell]);
    const SplineAxis& spline = grid.splines[static_cast<std::size_t>(d)];
    first[d] = taps == 2 ? cell : spline.first[static_cast<std::size_t>(cell)];
    const double* b = spline.basis.data() + 16 * cell;
    for (int j = 0; j < taps; ++j)
      w[d][j] =
          taps == 2 ? (j ? t : 1 - t) : b[j] + t * (b[4 + j] + t * (b[8 + j] + t * b[12 + j]));
  }
  const double* value = taps == 2 ? grid.value.data() : grid.coefficients.data();
  const auto n = [&](int d) { return grid.linear[static_cast<std::size_t>(d)].n; };
  double sum = 0;
  for (int a = 0; a < taps; ++a)
    for (int b = 0; b < taps; ++b)
      for (int c = 0; c < taps; ++c)
        for (int d = 0; d < taps; ++d)
          for (int e = 0; e < taps; ++e) {
            int at = first[0] + a;
            at = at * n(1) + first[1] + b;
            at = at * n(2) + first[2] + c;
            at = at * n(3) + first[3] + d;
            at = at * n(4) + first[4] + e;
            sum += w[0][a] * w[1][b] * w[2][c] * w[3][d] * w[4][e] * value[at];
          }
  return sum;
}

template <class Query> void run(benchmark::State& state, bool even, Query query) {
  const Grid grid(state.range(0), even);
  for (auto _ : state)
    for (std::size_t i = 0; i < queries; ++i)
      benchmark::DoNotOptimize(query(grid, grid.u.data() + axes * i));
  state.counters["ns/query"] =
      benchmark::Counter(static_cast<double>(state.iterations() * queries) * 1e-9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

double by_u[axes];

void linear_nested(benchmark::State& state) {
  run(state, true, [](const Grid& g, const double* u) { return nested(g, u, 2); });
}
void linear_even(benchmark::State& state) {
  run(state, true, [](const Grid& g, const double* u) {
    return ft_interpolate(axes, g.linear.data(), g.value.data(), u, nullptr);
  });
}
void linear_uneven(benchmark::State& state) {
  run(state, false, [](const Grid& g, const double* u) {
    return ft_interpolate(axes, g.linear.data(), g.value.data(), u, nullptr);
  });
}
void linear_gradient(benchmark::State& state) {
  run(state, true, [](const Grid& g, const double* u) {
    return ft_interpolate_gradient(axes, g.linear.data(), g.value.data(), u, by_u, nullptr);
  });
}
void cubic_nested(benchmark::State& state) {
  run(state, true, [](const Grid& g, const double* u) { return nested(g, u, 4); });
}
void cubic_even(benchmark::State& state) {
  run(state, true, [](const Grid& g, const double* u) {
    return ft_cubic(axes, g.cubic.data(), g.coefficients.data(), u, nullptr);
  });
}
void cubic_uneven(benchmark::State& state) {
  run(state, false, [](const Grid& g, const double* u) {
    return ft_cubic(axes, g.cubic.data(), g.coefficients.data(), u, nullptr);
  });
}
void cubic_gradient(benchmark::State& state) {
  run(state, true, [](const Grid& g, const double* u) {
    return ft_cubic_gradient(axes, g.cubic.data(), g.coefficients.data(), u, by_u, nullptr);
  });
}
BENCHMARK(linear_nested)->Arg(0)->Arg(1);
BENCHMARK(linear_even)->Arg(0)->Arg(1);
BENCHMARK(linear_uneven)->Arg(0)->Arg(1);
BENCHMARK(linear_gradient)->Arg(0)->Arg(1);
BENCHMARK(cubic_nested)->Arg(0)->Arg(1);
BENCHMARK(cubic_even)->Arg(0)->Arg(1);
BENCHMARK(cubic_uneven)->Arg(0)->Arg(1);
BENCHMARK(cubic_gradient)->Arg(0)->Arg(1);

} // namespace
} // namespace frictab
