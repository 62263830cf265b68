// Speed of calibration and of table queries, each beside a reference in the same run.
#include <cmath>

#include <benchmark/benchmark.h>

#include "calibrate/calibration.h"
#include "support/sample_data.h"
#include "table/drift.h"
#include "twin/twin.h"

namespace frictab {

using calibrate::Loss;

namespace {

const twin::Twin& campaign() {
  static const twin::Twin twin = twin::make_twin({});
  return twin;
}

// One law on the 44,550 rows of the synthetic campaign, standard errors included.
void calibrate_law(benchmark::State& state, const char* law, Loss loss) {
  calibrate::CalibrationInput input{campaign().training.data, campaign().validation.data, {}, {}};
  input.models.use = {law};
  input.options.loss = loss;
  for (auto _ : state)
    benchmark::DoNotOptimize(calibrate::calibrate(input).fits.front());
}
// Every calibrated law, and the errors and intervals of all on training and validation rows.
void calibrate_all(benchmark::State& state, Loss loss) {
  calibrate::CalibrationInput input{campaign().training.data, campaign().validation.data, {}, {}};
  for (const models::Law& law : models::all_laws())
    if (law.calibrated == models::Calibrated::fit) input.models.use.push_back(law.name);
  input.options.loss = loss;
  for (auto _ : state)
    benchmark::DoNotOptimize(calibrate::calibrate(input).fits.front());
}
BENCHMARK_CAPTURE(calibrate_all, closed_forms_L2, Loss::l2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(calibrate_all, closed_forms_L1, Loss::l1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(calibrate_law, coulomb_L2, "coulomb", Loss::l2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(calibrate_law, orowan_L2, "orowan", Loss::l2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(calibrate_law, orowan_L1, "orowan", Loss::l1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(calibrate_law, log_coulomb_L2, "log_coulomb", Loss::l2)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(calibrate_law, log_coulomb_L1, "log_coulomb", Loss::l1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(calibrate_law, wzl_L2, "wzl", Loss::l2)->Unit(benchmark::kMillisecond);

// Queries at random states: the table as the tool evaluates it, and the law itself.
struct Query {
  explicit Query(const char* name) : model(test::plausible_model(*models::find_law(name))) {
    const data::Dataset data = test::sample_data(model);
    table = table::build_table(models::AssembledLaw(model),
                               table::state_ranges(models::AssembledLaw(model), data, {}), {});
    states = test::random_states(table.inputs(), count, 5);
    for (const auto& column : states)
      columns.push_back(column.data());
    tau.resize(count);
  }
  static constexpr std::size_t count = 4096;
  models::Model model;
  table::Table table;
  std::vector<std::vector<double>> states;
  std::vector<const double*> columns;
  std::vector<double> tau;
};

void query_table(benchmark::State& state, const char* law) {
  Query query(law);
  const table::TableFunction function(query.table);
  for (auto _ : state) {
    function.evaluate(Query::count, query.columns, query.tau);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * Query::count));
}

void query_law(benchmark::State& state, const char* law) {
  Query query(law);
  const table::LawFunction function(models::AssembledLaw(query.model), query.table.inputs());
  for (auto _ : state) {
    function.evaluate(Query::count, query.columns, query.tau.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * Query::count));
}
BENCHMARK_CAPTURE(query_table, log_coulomb, "log_coulomb");
BENCHMARK_CAPTURE(query_law, log_coulomb, "log_coulomb");
BENCHMARK_CAPTURE(query_table, wanheim_bay, "wanheim_bay");
BENCHMARK_CAPTURE(query_law, wanheim_bay, "wanheim_bay");

// A network on rows, beside as many tanh of the library: 20 nets of 8 units, as trained.
constexpr std::size_t nets = 20, units = 8, network_rows = 65536;

void evaluate_network(benchmark::State& state) {
  const models::AssembledLaw law(test::network_model(nets, units));
  const std::vector<std::string>& inputs = law.inputs;
  const auto states = test::random_states(inputs, network_rows, 5);
  std::vector<const double*> columns;
  for (const auto& column : states)
    columns.push_back(column.data());
  const table::LawFunction function(law, inputs);
  std::vector<double> tau(network_rows);
  for (auto _ : state) {
    function.evaluate(network_rows, columns, tau.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * network_rows));
}
BENCHMARK(evaluate_network)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

void tanh_of_the_library(benchmark::State& state) {
  const auto x = test::random_states({"v_rel_mm_s"}, network_rows, 5).front();
  for (auto _ : state) {
    double sum = 0;
    for (std::size_t unit = 0; unit < nets * units; ++unit)
      for (const double value : x)
        sum += std::tanh(value / 500 - 0.01 * static_cast<double>(unit));
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * network_rows));
}
BENCHMARK(tanh_of_the_library)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

} // namespace
} // namespace frictab
