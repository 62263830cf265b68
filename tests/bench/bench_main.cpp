// Runs the benchmarks with repetitions in random order and prints ratios of the smallest times of
// an iteration (some 0.1 to 2 ms of thread CPU time): a shared machine only ever adds to a time.
#include <cmath>
#include <cstring>
#include <ctime>
#include <map>

#include <fmt/format.h>

#include "bench/bench.h"
#include "bench/generated_kernels.h"

namespace frictab::bench {

namespace {

std::vector<void (*)()>& registrations() {
  static std::vector<void (*)()> all;
  return all;
}

using Times = std::map<std::string, double>;

// ns per query by name, of the fastest iteration so far.
Times& smallest() {
  static Times all;
  return all;
}

double thread_ns() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

// Leaves the benchmarks of `measure` to the tables behind the run.
class Reporter : public benchmark::ConsoleReporter {
public:
  void ReportRuns(const std::vector<Run>& runs) override {
    std::vector<Run> others;
    for (const Run& run : runs)
      if (!smallest().count(run.run_name.function_name)) others.push_back(run);
    if (!others.empty()) ConsoleReporter::ReportRuns(others);
  }
};

// Peers that Debian does not ship: ns per query from the project's notes on tables (2026-11-21,
// sections 2.1, 2.2 and 6; two cores of an AMD EPYC Zen 3, g++ 12.2, 17x9x9x9x17 nodes in double,
// each peer as it is fastest). They are quoted, not run. What both runs have is a plain nested loop
// over that table: 53.5 ns there.
constexpr double quoted_nested = 53.5;
struct Goal {
  const char* what;
  const char* ours; // benchmark, without the flags
  const char* peer;
  double quoted_ns;
  double at_most; // of the peer
};
const Goal goals[] = {
    {"linear, uniform axes", "linear/uniform/value/210681", "spiner", 51.7, 0.55},
    {"linear, uniform axes", "linear/uniform/value/210681", "EconForge", 38.7, 0.75},
    {"linear, uniform axes", "linear/uniform/value/210681", "CasADi", 177.6, 0.17},
    {"linear, arbitrary axes", "linear/arbitrary/value/210681", "EconForge", 142, 0.30},
    {"linear, arbitrary axes", "linear/arbitrary/value/210681", "finterp", 168.5, 0.24},
    {"linear, arbitrary axes", "linear/arbitrary/value/210681", "mlinterp", 254, 0.16},
    {"cubic", "cubic/uniform/value/210681", "CasADi blazing", 437, 0.75},
    {"cubic, arbitrary axes", "cubic/arbitrary/value/210681", "CasADi blazing", 437, 0.75},
    {"cubic + gradient", "cubic/uniform/gradient/210681", "CasADi blazing", 1100, 0.45},
    {"linear + gradient, arbitrary", "linear/arbitrary/gradient/210681", "finterp's value", 168.5,
     0.30},
};

double time_of(const Times& times, const std::string& name) {
  const auto found = times.find(name);
  return found == times.end() ? 0 : found->second;
}

void print_times(const Times& times) {
  fmt::print("\nns per query, of the fastest iteration; share of the nested loop compiled alike\n");
  for (const auto& [name, ns] : times) {
    std::string nested = name;
    for (const char* kind : {"/value/", "/gradient/", "/f32/"})
      if (const auto at = nested.find(kind); at != std::string::npos)
        nested.replace(at, std::strlen(kind), "/nested/");
    nested = nested.substr(0, nested.rfind('/') + 1) + (name.ends_with("native") ? "native" : "O2");
    const double reference = time_of(times, nested);
    fmt::print("  {:<44} {:8.1f}{}\n", name, ns,
               reference > 0 && nested != name ? fmt::format("  {:.2f}", ns / reference) : "");
  }
}

void print_pair(const Times& times, const char* what, const std::string& a, const std::string& b,
                const char* goal) {
  const double x = time_of(times, a), y = time_of(times, b);
  if (x > 0 && y > 0) fmt::print("  {:<58} {:.2f}  {}\n", what, x / y, goal);
}

void print_ratios(const Times& times) {
  fmt::print("\nRatios measured in this run\n");
  for (const char* flags : {"O2", "native"}) {
    const std::string f = flags, grid = "/210681/" + f;
    for (const char* kind : {"linear/uniform", "linear/arbitrary", "cubic/uniform"})
      print_pair(times, fmt::format("{} {}: value + gradient to value", kind, f).c_str(),
                 std::string(kind) + "/gradient" + grid, std::string(kind) + "/value" + grid,
                 kind[0] == 'l' ? "goal 1.70" : "");
    print_pair(times, ("2-D bilinear " + f + " to GSL").c_str(),
               "linear/arbitrary/value/33x33/" + f, "linear/arbitrary/value/33x33/gsl", "");
    print_pair(times, ("2-D bicubic " + f + " to GSL").c_str(), "cubic/arbitrary/value/33x33/" + f,
               "cubic/arbitrary/value/33x33/gsl", "");
  }
  const double nested = time_of(times, "linear/uniform/nested/210681/O2");
  if (nested == 0) return;
  const double speed = nested / quoted_nested;
  fmt::print(
      "\nPeers quoted from notes of 2026-11-21, not run; times {:.2f}, by which this run's nested "
      "loop differs from that one's\n  {:<30} {:<16} {:>7} {:>8} {:>8}   goal\n",
      speed, "", "peer", "its ns", "O2", "native");
  const auto row = [&](const char* what, const char* peer, double ns, const std::string& a,
                       const std::string& b, double goal) {
    const auto ratio = [&](const std::string& name) {
      const double ours = time_of(times, name);
      return ours > 0 ? fmt::format("{:.2f}", ours / (ns * speed)) : std::string("-");
    };
    fmt::print("  {:<30} {:<16} {:7.1f} {:>8} {:>8}   {:.2f}\n", what, peer, ns * speed, ratio(a),
               ratio(b), goal);
  };
  for (const Goal& goal : goals)
    row(goal.what, goal.peer, goal.quoted_ns, std::string(goal.ours) + "/O2",
        std::string(goal.ours) + "/native", goal.at_most);
  for (const char* axes : {"uniform", "arbitrary"})
    row(fmt::format("generated Fortran, {}", axes).c_str(), "finterp", 168.5,
        fmt::format("linear/{}/value/210681/fortran", axes), "", 0.25);
}

} // namespace

Registration::Registration(void (*add)()) {
  registrations().push_back(add);
}

void measure(const std::string& name, std::size_t queries, std::function<void()> iteration) {
  const auto run = [name, queries, iteration](benchmark::State& state) {
    iteration(); // compiles what it needs, warms the caches
    double& ns = smallest().emplace(name, HUGE_VAL).first->second;
    for (auto _ : state) {
      const double start = thread_ns();
      iteration();
      ns = std::min(ns, (thread_ns() - start) / static_cast<double>(queries));
    }
  };
  benchmark::RegisterBenchmark(name.c_str(), run)->Repetitions(15)->MinTime(0.01);
}

} // namespace frictab::bench

int main(int argc, char** argv) {
  using namespace frictab::bench;
  if (argc == 2 && std::string(argv[1]).rfind("--write=", 0) == 0) {
    write_generated(argv[1] + std::strlen("--write="));
    return 0;
  }
  std::vector<char*> arguments(argv, argv + argc);
  std::string interleave = "--benchmark_enable_random_interleaving=true";
  arguments.insert(arguments.begin() + 1, interleave.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  for (const auto add : registrations())
    add();
  Reporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  if (!smallest().empty()) {
    print_times(smallest());
    print_ratios(smallest());
  }
  return 0;
}
