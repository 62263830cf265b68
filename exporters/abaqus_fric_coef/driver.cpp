// Puts rows of states into blocks of contact points, one per call where the law has a history.
#include "driver.h"

#include <algorithm>

#include "../abaqus/standard.h"
#include "call.h"
#include "codegen/compile.h"
#include "codegen/driver_rows.h"
#include "codegen/histories.h"
#include "source.h"

namespace frictab::abaqus_fric_coef {

namespace {

constexpr std::size_t block = 136;

class Block {
public:
  Block(void* function, const ExportRequest& request)
      : function_(function), inputs_(solver_inputs(request, gives(is_2024(request)))),
        stress_(solver_unit("MPa", request.units)), work_over_(abaqus::work_over(request.units)) {
    call_.release_2024 = is_2024(request);
    call_.temperatures = true;
    call_.properties.assign(property_count(inputs_), 0);
    const bool history = uses(inputs_, Source::work) || uses(inputs_, Source::peak_pressure) ||
                         uses(inputs_, Source::history);
    if (history) call_.states = static_cast<int>(abaqus::states_size(state_count(inputs_)));
    most_ = history ? 1 : block;
    for (const SolverInput& input : inputs_)
      call_.fields = std::max(call_.fields, static_cast<int>(input.field));
  }

  const std::vector<SolverInput>& inputs() const { return inputs_; }
  std::size_t most() const { return most_; }

  void run(std::span<const std::size_t> rows, std::span<const double* const> columns,
           std::span<double> tau) {
    call_.resize(static_cast<int>(rows.size()));
    std::fill(call_.pressure.begin(), call_.pressure.end(),
              stress_.from_canonical(abaqus::any_pressure));
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (std::size_t k = 0; k < rows.size(); ++k)
        set(inputs_[c], k, columns[c][rows[k]]);
    const std::vector<double> past = history_values(inputs_, columns, rows[0]);
    if (!past.empty())
      std::copy(past.begin(), past.end(), call_.state.begin() + abaqus_fric_coef::history);
    call_.run(function_);
    for (std::size_t k = 0; k < rows.size(); ++k)
      tau[rows[k]] = stress_.to_canonical(call_.coefficient[k] * call_.pressure[k]);
  }

private:
  void set(const SolverInput& input, std::size_t k, double canonical) {
    const auto n = static_cast<std::size_t>(call_.points);
    const double value = input.argument.solver.from_canonical(canonical);
    switch (input.source) {
    case Source::pressure:
      call_.pressure[k] = value;
      break;
    case Source::speed:
      call_.slip[k] = value;
      break;
    case Source::slip:
      call_.slip[3 * n + k] = value;
      break;
    case Source::work:
      call_.state[0] = canonical * work_over_;
      break;
    case Source::peak_pressure:
      call_.state[1] = stress_.from_canonical(canonical);
      break;
    case Source::temperature:
      call_.temperature[k] = value;
      break;
    case Source::field:
      call_.field[(input.field - 1) * n + k] = value;
      break;
    case Source::property:
      call_.properties[input.property - 1] = value;
      break;
    default:
      break; // constants are in the source
    }
  }

  void* function_;
  std::vector<SolverInput> inputs_;
  SolverUnit stress_;
  double work_over_;
  std::size_t most_;
  CoefCall call_;
};

} // namespace

void drive(const Built& built, const ExportRequest& request, std::size_t rows,
           std::span<const double* const> columns, std::span<double> tau) {
  Block call(Library::address(built.library, "fric_coef_"), request);
  std::vector<std::size_t> asked;
  for (std::size_t row = 0; row < rows; ++row)
    if (posed(call.inputs(), columns, row, abaqus::any_pressure)) asked.push_back(row);
  for (const std::vector<std::size_t>& group :
       call_groups(call.inputs(), std::move(asked), columns, call.most()))
    call.run(group, columns, tau);
}

} // namespace frictab::abaqus_fric_coef
