// Interpolation, ns per query at random states, as a user of generated code has it: value, and
// value with all derivatives, linear and cubic, in double and single precision; in the same run a
// textbook's nested loop, GSL in two axes, the kinked law with all its maps, and values on disk.
#include <map>

#include "bench/bench.h"
#include "bench/generated_kernels.h"
#include "core/program.h"
#include "core/random.h"
#include "support/kinked_law.h"
#include "table/drift.h"

#include <gsl/gsl_interp2d.h>
#include <gsl/gsl_spline2d.h>

namespace frictab::bench {

using table::Table;

namespace {

constexpr std::size_t queries = 4096;

// 4,800 nodes, as neural_network needs at 0.5 MPa; 210,681 nodes, larger than the L2 cache; a plane
// for GSL.
const std::map<std::string, std::vector<std::size_t>> grids = {
    {"4800", {6, 4, 5, 5, 8}}, {"210681", {17, 9, 9, 9, 17}}, {"33x33", {33, 33}}};

const std::vector<double>& states(std::size_t axes) {
  static std::map<std::size_t, std::vector<double>> all;
  std::vector<double>& u = all[axes];
  Random random(2);
  while (u.size() < axes * queries)
    u.push_back(random.uniform());
  return u;
}

// `make` gives what is called per state; asked once per 4096 of them, so that it costs nothing.
template <class Make>
void add(const std::string& name, const double* state, std::size_t size, Make make) {
  measure(name, queries, [make, state, size] {
    const auto query = make();
    const double* u = state;
    for (std::size_t i = 0; i < queries; ++i, u += size)
      benchmark::DoNotOptimize(query(u));
  });
}
template <class Make> void add(const std::string& name, std::size_t axes, Make make) {
  add(name, states(axes).data(), axes, make);
}

// Compiled where it is first asked for: a filter pays for what it runs only.
template <class Kernel, class... Arguments> auto lazy(Arguments... arguments) {
  auto kernel = std::make_shared<std::unique_ptr<Kernel>>();
  return [kernel, arguments...]() -> const Kernel& {
    if (!*kernel) *kernel = std::make_unique<Kernel>(arguments...);
    return **kernel;
  };
}

void add_generated_c(const std::string& name, const std::string& grid, const Table& table) {
  for (const bool native : {false, true}) {
    const auto kernel = lazy<CKernel>(table, native ? std::vector<std::string>{"-march=native"}
                                                    : std::vector<std::string>{});
    const std::string tail = "/" + grid + (native ? "/native" : "/O2");
    const std::size_t axes = table.axes.size();
    add(name + "/nested" + tail, axes, [kernel] { return kernel().nested; });
    add(name + "/value" + tail, axes, [kernel] { return kernel().value; });
    add(name + "/f32" + tail, axes, [kernel] { return kernel().single; });
    add(name + "/gradient" + tail, axes, [kernel] {
      return [gradient = kernel().gradient](const double* u) {
        double by_u[5];
        const double value = gradient(u, by_u);
        benchmark::DoNotOptimize(by_u);
        return value;
      };
    });
  }
}

void add_table(const std::string& grid, bool even, bool cubic) {
  const Table table = random_table(grids.at(grid), even, cubic);
  const std::string name =
      std::string(cubic ? "cubic" : "linear") + (even ? "/uniform" : "/arbitrary");
  const std::size_t axes = table.axes.size();
  add_generated_c(name, grid, table);
  const auto fortran = lazy<FortranKernel>(table);
  add(name + "/value/" + grid + "/fortran", axes, [fortran] { return fortran().value; });
  const auto slopes = lazy<FortranKernel>(table, true);
  add(name + "/value/" + grid + "/fortran with gradient", axes,
      [slopes] { return slopes().value; });
  add(name + "/gradient/" + grid + "/fortran", axes, [slopes] {
    return [gradient = slopes().gradient](const double* u) {
      double value, by_u[5];
      const int flag = 1;
      gradient(u, &value, by_u, &flag);
      benchmark::DoNotOptimize(by_u);
      return value;
    };
  });
  const auto function = std::make_shared<table::TableFunction>(table);
  add(name + "/value/" + grid + "/frictab", axes, [function, axes] {
    return [f = function.get(), axes](const double* u) { return (*f)({u, axes}); };
  });
}

void add_gsl(const gsl_interp2d_type* type, const std::string& name) {
  const Table table = random_table(grids.at("33x33"), false, false);
  const std::vector<double>&x = table.axes[0].nodes, &y = table.axes[1].nodes;
  std::shared_ptr<gsl_spline2d> spline(gsl_spline2d_alloc(type, x.size(), y.size()),
                                       gsl_spline2d_free);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < y.size(); ++j)
      gsl_spline2d_set(spline.get(), spline->zarr, i, j, table.value[i * y.size() + j]);
  const std::vector<double> z(spline->zarr, spline->zarr + x.size() * y.size());
  gsl_spline2d_init(spline.get(), x.data(), y.data(), z.data(), x.size(), y.size());
  const auto accelerator = [] {
    return std::shared_ptr<gsl_interp_accel>(gsl_interp_accel_alloc(), gsl_interp_accel_free);
  };
  const auto in_x = accelerator(), in_y = accelerator();
  add(name + "/arbitrary/value/33x33/gsl", 2, [=] {
    return [&](const double* u) {
      return gsl_spline2d_eval(spline.get(), u[0], u[1], in_x.get(), in_y.get());
    };
  });
}

using Columns = std::vector<std::vector<double>>;

// The entries for many states of the targets that have the contract's, by as many as a solver
// passes at once; columns: sigma_n, psi, v, T, sigma_f.
void add_batches(const std::string& name, const Table& table,
                 const std::shared_ptr<const Columns>& columns) {
  for (const char* target : {"c", "fortran"}) {
    const auto entries = lazy<BatchEntries>(table, std::string(target));
    for (const std::size_t block : {1, 16, 136, 512}) {
      const auto each = [=](const auto& call) {
        const Columns& x = *columns;
        for (std::size_t i = 0; i < queries; i += block)
          call(std::min(block, queries - i), i, x);
      };
      const std::string tail = std::string(target) + "/" + std::to_string(block);
      measure(name + "/value/" + tail, queries, [=, tau = std::vector<double>(queries)]() mutable {
        each([&, batch = entries().value](std::size_t n, std::size_t i, const Columns& x) {
          batch(n, &x[0][i], &x[1][i], &x[2][i], &x[3][i], nullptr, &x[4][i], &tau[i]);
        });
        benchmark::DoNotOptimize(tau.data());
      });
      measure(
          name + "/gradient/" + tail, queries,
          [=, tau = std::vector<double>(queries),
           slopes = std::vector<double>(6 * queries)]() mutable {
            each([&, batch = entries().gradient](std::size_t n, std::size_t i, const Columns& x) {
              batch(n, &x[0][i], &x[1][i], &x[2][i], &x[3][i], nullptr, &x[4][i], &tau[i],
                    &slopes[6 * i]);
            });
            benchmark::DoNotOptimize(slopes.data());
          });
    }
  }
}

// The law of tests/support/kinked_law.h at 0.01 MPa: logarithms of three axes, lookup, exponential,
// min; and the law itself.
void add_kinked() {
  const models::Model model = test::kinked_model();
  table::TableOptions options;
  options.tolerance_MPa = 0.01;
  options.interpolation = table::Interpolation::linear;
  const auto ranges = test::kinked_ranges();
  const Table table = table::build_table(models::AssembledLaw(model), ranges, options);
  constexpr std::size_t n = 5;
  auto rows = std::make_shared<std::vector<double>>(states(n)); // states, one after the other
  auto columns = std::make_shared<Columns>(n);
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const table::StateRange& range = ranges[i % n];
    double& x = (*rows)[i];
    x = range.low + x * (range.high - range.low);
    (*columns)[i % n].push_back(x);
  }
  const std::string tail = "/" + std::to_string(table.nodes());
  add_batches("kinked/batch" + tail, table, columns);
  for (const char* flags : {"-O2", "-march=native"}) {
    const auto kernel = lazy<CKernel>(table, std::vector<std::string>{flags});
    add("kinked/tau" + tail + (std::string(flags) == "-O2" ? "/O2" : "/native"), rows->data(), n,
        [kernel, rows] {
          const auto tau = kernel().tau;
          return [tau](const double* x) { return tau(x[0], x[1], x[2], x[3], 0, x[4]); };
        });
  }
  const auto function = std::make_shared<table::TableFunction>(table);
  add("kinked/tau" + tail + "/frictab", rows->data(), n, [function, rows] {
    const table::TableFunction* f = function.get();
    return [f](const double* x) { return (*f)({x, n}); };
  });
  std::vector<const double*> pointers;
  for (const auto& column : *columns)
    pointers.push_back(column.data());
  auto tau = std::make_shared<std::vector<double>>(queries);
  measure("kinked/tau" + tail + "/frictab batch", queries,
          [=] { (void)columns, function->evaluate(queries, pointers, *tau); });
  const auto law =
      std::make_shared<table::LawFunction>(models::AssembledLaw(model), function->inputs());
  measure("kinked/law/frictab batch", queries,
          [=] { law->evaluate(queries, pointers, tau->data()); });
}

const Registration kernels([] {
  for (const char* grid : {"4800", "210681"})
    for (const bool cubic : {false, true})
      for (const bool even : {true, false})
        add_table(grid, even, cubic);
  for (const bool cubic : {false, true})
    add_table("33x33", false, cubic);
  add_gsl(gsl_interp2d_bilinear, "linear");
  add_gsl(gsl_interp2d_bicubic, "cubic");
  add_kinked();
});

} // namespace
} // namespace frictab::bench
