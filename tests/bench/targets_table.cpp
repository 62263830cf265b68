// Every target with every table of a job and every compiler: whether it compiles, runs and agrees
// with frictab's own evaluation, and what a contact point costs; as lines of Markdown. The same for
// two grids that are looked up and nothing else, beside the interpolation kernel written by hand
// (src/table/frictab_kernel.h, compiled alike).
// Argument: the output directory of `frictab run`, with tables of the laws that are wanted; or
// --blocks, for VFRIC with all its arguments alone.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>

#include <dlfcn.h>
#include <fmt/format.h>
#include <time.h>

#include "bench/generated_kernels.h"
#include "codegen/exporter.h"
#include "support/calls/vfric.h"
#include "support/sample_tables.h"
#include "table/table_file.h"

namespace frictab::bench {

using codegen::BuildVariant;
using codegen::Exporter;
using codegen::ExportRequest;

namespace {

constexpr std::size_t rows = 4080; // 30 blocks of 136 contact points
constexpr int passes = 100;

double thread_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// The fastest of many passes, ns per state; `kernel` (may be empty) takes turns with it, since a
// shared processor changes its pace.
struct Times {
  double ns, kernel_ns;
};
Times times(const std::function<void()>& pass, const std::function<void()>& kernel) {
  Times best = {1e300, kernel ? 1e300 : std::nan("")};
  const auto measure = [](const std::function<void()>& run, double& least) {
    const double before = thread_seconds();
    run();
    least = std::min(least, 1e9 * (thread_seconds() - before) / static_cast<double>(rows));
  };
  for (int i = 0; i < passes; ++i) {
    measure(pass, best.ns);
    if (kernel) measure(kernel, best.kernel_ns);
  }
  return best;
}

// The median over many passes of a pass' time over that of the kernel directly after it: on a
// processor that changes its pace the fastest of each need not have had the same one.
double median_ratio(const std::function<void()>& pass, const std::function<void()>& kernel) {
  std::vector<double> ratios;
  for (int i = 0; i < passes; ++i) {
    const double start = thread_seconds();
    pass();
    const double between = thread_seconds();
    kernel();
    ratios.push_back((between - start) / (thread_seconds() - between));
  }
  std::nth_element(ratios.begin(), ratios.begin() + passes / 2, ratios.end());
  return ratios[passes / 2];
}

// What a contact point costs without the solver's arguments around it: the entry for many states,
// or the common core of the Fortran routines, one state after the other. NaN where there is
// neither.
Times times_of(const Exporter& exporter, const ExportRequest& request, void* library,
               const test::States& states, const std::function<void()>& kernel) {
  std::vector<double> tau(rows);
  if (exporter.has_batch())
    return times([&] { exporter.batch(library, request, rows, states.columns(), tau); }, kernel);
  auto* core =
      library ? reinterpret_cast<double (*)(const double*)>(dlsym(library, "fttau_")) : nullptr;
  if (!core) return {std::nan(""), std::nan("")};
  const std::size_t n = states.columns().size();
  std::vector<double> x;
  for (std::size_t i = 0; i < rows; ++i)
    for (const double* column : states.columns())
      x.push_back(column[i]);
  return times(
      [&] {
        for (std::size_t i = 0; i < rows; ++i)
          tau[i] = core(&x[n * i]);
      },
      kernel);
}

// The recipe's compiler, and clang where that one is gcc.
std::vector<BuildVariant> compilers(const Exporter& exporter, const ExportRequest& request) {
  std::vector<BuildVariant> out = exporter.variants(request);
  for (std::size_t i = 0, n = out.size(); i < n; ++i)
    if (!out[i].command.empty() && out[i].command[0] == "gcc") {
      out.push_back(out[i]);
      out.back().command[0] = "clang";
    }
  return out;
}

struct Subject {
  std::string name;
  table::Table table;
  double spread;                // beyond the ends of the axes
  std::function<void()> kernel; // the same lookups by hand
};

void print_line(const Subject& subject, const Exporter& exporter, const ExportRequest& request,
                const BuildVariant& variant, const test::States& states,
                const std::vector<double>& truth) {
  const std::string who = fmt::format(
      "| {} | {} | {}", subject.name, exporter.name,
      variant.command.empty() ? variant.interpreter : variant.command[0] + " " + variant.name);
  const codegen::SourceBundle bundle = exporter.generate(request);
  std::vector<double> tau(rows, std::nan(""));
  Times cost = {std::nan(""), std::nan("")};
  std::size_t asked = 0;
  try {
    const codegen::CompiledTarget target(exporter, request, bundle, variant);
    const auto drive = [&] { target.drive(rows, states.columns(), tau); };
    drive();
    asked = static_cast<std::size_t>(
        std::count_if(tau.begin(), tau.end(), [](double t) { return !std::isnan(t); }));
    cost = times_of(exporter, request, target.handle(), states, subject.kernel);
  } catch (const std::exception& error) {
    fmt::print("{} | FAILED: {} |\n", who, std::string(error.what()).substr(0, 200));
    return;
  }
  std::vector<double> expected = truth;
  for (std::size_t i = 0; i < rows; ++i)
    if (std::isnan(tau[i])) expected[i] = tau[i]; // not representable
  fmt::print("{} | {} of {} | {} | {} | {} |\n", who, asked, rows,
             subject.kernel ? "-" : fmt::format("{:.1e}", test::worst_relative(tau, expected)),
             std::isnan(cost.ns) ? "-" : fmt::format("{:.0f}", cost.ns),
             subject.kernel && !std::isnan(cost.ns)
                 ? fmt::format("{:.2f}", cost.ns / cost.kernel_ns)
                 : "-");
  std::fflush(stdout);
}

void print_subject(const Subject& subject) {
  const std::map<std::string, double> fixed = {{"psi", 0.7}, {"s_mm", 0.3}};
  const std::map<std::string, double> in_range = {{"psi", 2.5}, {"sigma_f_MPa", 480.0}};
  const test::States states(subject.table, rows, 41, subject.spread,
                            subject.kernel ? fixed : in_range);
  const std::vector<double> truth = test::expected(subject.table, states);
  for (const Exporter& exporter : codegen::all_exporters()) {
    if (!exporter.is_routine()) continue;
    const ExportRequest request{subject.table, "mm-t-s", {}};
    for (const BuildVariant& variant : compilers(exporter, request))
      if (have_program(variant.program()))
        print_line(subject, exporter, request, variant, states, truth);
  }
}

// [0, 1] on every axis, nothing but the lookup.
Subject grid(const std::vector<std::size_t>& counts) {
  Subject out{"", random_table(counts, true, false), 0, {}};
  out.table.model = "grid";
  out.name = fmt::format("{} nodes", out.table.nodes());
  const auto kernel = std::make_shared<CKernel>(out.table);
  const test::States states(out.table, rows, 41, 0, {{"psi", 0.7}, {"s_mm", 0.3}});
  std::vector<double> u;
  for (std::size_t i = 0; i < rows; ++i)
    for (const table::TableAxis& axis : out.table.axes) {
      const std::vector<std::string> inputs = out.table.inputs();
      const auto c = std::find(inputs.begin(), inputs.end(), axis.name) - inputs.begin();
      u.push_back(states.columns()[static_cast<std::size_t>(c)][i]);
    }
  const std::size_t axes = out.table.axes.size();
  out.kernel = [kernel, u, axes, value = std::vector<double>(rows)]() mutable {
    for (std::size_t i = 0; i < rows; ++i)
      value[i] = kernel->value(&u[axes * i]);
  };
  return out;
}

// VFRIC with all its arguments, by contact points per call: the states of `subject`.
void print_blocks(const Subject& subject) {
  const Exporter& exporter = *codegen::find_exporter("abaqus_vfric");
  const ExportRequest request{subject.table, "mm-t-s", {}};
  const BuildVariant variant = exporter.variants(request)[0];
  if (!have_program(variant.program())) return;
  const codegen::CompiledTarget target(exporter, request, exporter.generate(request), variant);
  void* routine = codegen::Library::address(target.handle(), "vfric_");
  const test::States states(subject.table, rows, 41, 0, {{"psi", 0.7}, {"s_mm", 0.3}});
  for (const int block : {1, 16, 136, 510}) {
    std::vector<calls::VfricCall<double>> calls(rows / static_cast<std::size_t>(block));
    std::size_t row = 0;
    for (auto& call : calls) {
      call.states = 6;
      call.temperatures = true;
      call.time_increment = 0x1p-40;
      call.properties = {0.7};
      call.resize(block, block);
      for (int k = 0; k < block; ++k, ++row) {
        const auto at = static_cast<std::size_t>(k);
        const auto value = [&](std::size_t input) { // of a state that fewer axes leave out
          return input < states.columns().size() ? states.columns()[input][row] : 0.5;
        };
        call.normal[at] = value(0);
        call.slip[3 * at] = value(2) * 0x1p-40;
        call.temperature[at] = call.temperature_main[at] = value(3);
        call.state[6 * at] = 0.3;
      }
    }
    const auto in_kernels = [&](void* function) {
      return median_ratio(
          [&] {
            for (auto& call : calls)
              call.run(function);
          },
          subject.kernel);
    };
    // Less what making the arguments takes.
    const double ratio = in_kernels(routine) - in_kernels(reinterpret_cast<void*>(+[] {}));
    fmt::print("| {} | abaqus_vfric, all arguments, blocks of {} | gfortran double | | | | {:.2f} "
               "|\n",
               subject.name, block, ratio);
  }
}

int run(const std::filesystem::path& directory, bool blocks_only) {
  fmt::print("| table | target | compiler | rows asked | largest difference, relative | ns per "
             "point | over the kernel |\n|---|---|---|--:|--:|--:|--:|\n");
  for (const std::vector<std::size_t>& counts :
       {std::vector<std::size_t>{17, 9}, {6, 4, 5, 5, 8}, {17, 9, 9, 9, 17}}) {
    const Subject subject = grid(counts);
    if (!blocks_only) print_subject(subject);
    print_blocks(subject);
  }
  if (blocks_only) return 0;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(directory / "tables"))
    if (entry.path().extension() == ".h5") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    const table::Table table = table::read_table(file);
    print_subject({table.model, table, 0.1, {}});
  }
  return 0;
}

} // namespace
} // namespace frictab::bench

int main(int argc, char** argv) {
  const bool blocks_only = argc == 2 && std::string(argv[1]) == "--blocks";
  if (argc != 2) {
    fmt::print(stderr, "usage: frictab_bench_targets OUTPUT_OF_FRICTAB_RUN | --blocks\n");
    return 2;
  }
  return frictab::bench::run(argv[1], blocks_only);
}
