// Benchmarks that are named at run time, and what is printed behind them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace frictab::bench {

// Registers a benchmark whose one iteration makes `queries` of what is counted.
void measure(const std::string& name, std::size_t queries, std::function<void()> iteration);

// Calls what registers benchmarks once main runs.
struct Registration {
  explicit Registration(void (*add)());
};

} // namespace frictab::bench
