// Calls frictab_tau_R and frictab_tau_R_batch with the number of arguments they have.
#include "codegen/call_entry.h"

#include <array>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "codegen/compile.h"
#include "codegen/prefix.h"
#include "codegen/read_me.h"
#include "codegen/recipe.h"
#include "codegen/values_file.h"
#include "io/json.h"

namespace frictab::codegen {

namespace {

// Largest number of arguments: the contract's six, and 18 columns and histories of traced effects.
constexpr std::size_t most_arguments = 24;

template <std::size_t> using Number = double;

template <std::size_t... I>
double call(void* function, const std::vector<double>& x, std::index_sequence<I...>) {
  return reinterpret_cast<double (*)(Number<I>...)>(function)(x[I]...);
}

using Call = double (*)(void*, const std::vector<double>&);

template <std::size_t N> double call_with(void* function, const std::vector<double>& x) {
  return call(function, x, std::make_index_sequence<N>{});
}

template <std::size_t... N>
constexpr std::array<Call, sizeof...(N)> all_calls(std::index_sequence<N...>) {
  return {call_with<N>...};
}

template <std::size_t> using Array = const double*;

template <std::size_t... I>
void call_batch(void* function, std::size_t rows, const std::vector<const double*>& x, double* tau,
                std::index_sequence<I...>) {
  reinterpret_cast<void (*)(std::size_t, Array<I>..., double*)>(function)(rows, x[I]..., tau);
}

using CallBatch = void (*)(void*, std::size_t, const std::vector<const double*>&, double*);

template <std::size_t N>
void call_batch_with(void* function, std::size_t rows, const std::vector<const double*>& x,
                     double* tau) {
  call_batch(function, rows, x, tau, std::make_index_sequence<N>{});
}

template <std::size_t... N>
constexpr std::array<CallBatch, sizeof...(N)> all_batch_calls(std::index_sequence<N...>) {
  return {call_batch_with<N>...};
}

} // namespace

EntryTarget::EntryTarget(TargetDescription description) : Exporter(std::move(description)) {
  options = {values_option(), prefix_option()};
  several_laws = "give each law names of its own, [export.options] prefix = \"die_oil\"";
}

SourceBundle EntryTarget::generate(const ExportRequest& request) const {
  check_request(request);
  const Arguments inputs = entry_arguments(request.table, request.units);
  SourceBundle files = sources(request, inputs);
  add_values_file(files, request);
  json recipe = recipe_head(*this, request, "frictab_tau_R", files);
  add_interface(recipe, request, inputs);
  describe_entry(recipe, request, inputs, argument_type());
  add_compile(recipe, request);
  recipe["input_deck"] = nullptr;
  recipe["table"] = recipe_table(request);
  files["recipe.json"] = io::json_text(recipe);
  return with_prefix(explained(files, *this), request);
}

void EntryTarget::batch(void* library, const ExportRequest& request, std::size_t rows,
                        std::span<const double* const> columns, std::span<double> tau) const {
  static constexpr auto calls = all_batch_calls(std::make_index_sequence<most_arguments + 1>{});
  const std::vector<InputArgument> inputs = entry_arguments(request.table, request.units);
  if (inputs.size() > most_arguments) throw std::runtime_error("too many arguments to call with");
  std::vector<const double*> x(inputs.size(), nullptr);
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (const auto column = input_index(request.table, inputs[i].name)) x[i] = columns[*column];
  calls[inputs.size()](Library::address(library, prefixed(request, "frictab_tau_R_batch")), rows, x,
                       tau.data());
}

void EntryTarget::drive(const Built& built, const ExportRequest& request, std::size_t rows,
                        std::span<const double* const> columns, std::span<double> tau) const {
  static constexpr auto calls = all_calls(std::make_index_sequence<most_arguments + 1>{});
  const std::vector<InputArgument> inputs = entry_arguments(request.table, request.units);
  const std::vector<std::string> needed = request.table.inputs();
  if (inputs.size() > most_arguments) throw std::runtime_error("too many arguments to call with");
  void* function = Library::address(built.library, prefixed(request, "frictab_tau_R"));
  const SolverUnit stress = solver_unit("MPa", request.units);
  std::vector<double> x(inputs.size(), 0);
  std::vector<std::size_t> argument_of(needed.size());
  for (std::size_t c = 0; c < needed.size(); ++c)
    while (inputs[argument_of[c]].name != needed[c])
      ++argument_of[c];
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t c = 0; c < needed.size(); ++c)
      x[argument_of[c]] = inputs[argument_of[c]].solver.from_canonical(columns[c][row]);
    tau[row] = stress.to_canonical(calls[inputs.size()](function, x));
  }
}

} // namespace frictab::codegen
