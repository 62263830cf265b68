// Puts rows of states into blocks of contact nodes and calls USRFRC through its argument list.
#include "driver.h"

#include <algorithm>
#include <cmath>

#include "call.h"
#include "codegen/compile.h"
#include "codegen/driver_rows.h"
#include "codegen/histories.h"
#include "source.h"

namespace frictab::lsdyna_usrfrc {

namespace {

constexpr std::size_t block = 128; // nodes per call

// Powers of two: dividing by them changes no bits, so what the routine sees is the row's state.
constexpr double rate = 0x1p30;
double node_area(std::size_t k) {
  return std::ldexp(1.0, static_cast<int>(k % 4) - 2);
}

constexpr double some_pressure = 1; // in the solver's unit, for laws that do not ask for one

template <class Real, class Int> class Block {
public:
  Block(void* function, const ExportRequest& request)
      : function_(function), inputs_(solver_inputs(request, gives())),
        stress_(solver_unit("MPa", request.units)) {
    call_.constants.assign(property_count(inputs_), Real(0));
    call_.rate = Real(rate);
    call_.histories =
        static_cast<Int>(std::max<std::size_t>(4, state_count(request.table, inputs_)));
  }

  const std::vector<SolverInput>& inputs() const { return inputs_; }

  void run(std::span<const std::size_t> rows, std::span<const double* const> columns,
           std::span<double> tau) {
    const std::size_t count = rows.size();
    call_.resize(count);
    std::reverse(call_.history_of.begin(), call_.history_of.end()); // not in the nodes' order
    for (std::size_t k = 0; k < count; ++k) {
      call_.area[k] = static_cast<Real>(node_area(k));
      call_.normal[k] = Real(-some_pressure) * call_.area[k];
    }
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (std::size_t k = 0; k < count; ++k)
        set(inputs_[c], k, columns[c][rows[k]]);
    for (std::size_t k = 0; k < count; ++k) { // what was slipped before this cycle
      *history(k, 0) -= std::abs(call_.slip[1][k]);
      const std::vector<double> past = history_values(inputs_, columns, rows[k]);
      for (std::size_t i = 0; i < past.size(); ++i) {
        *history(k, 4 + i) = static_cast<Real>(past[i]);
        *history(k, 4 + past.size() + i) =
            static_cast<Real>(past[i] - static_cast<double>(*history(k, 4 + i)));
      }
    }
    call_.run(function_);
    for (std::size_t k = 0; k < count; ++k)
      tau[rows[k]] = stress_.to_canonical(static_cast<double>(call_.force[0][k]) / node_area(k));
  }

private:
  Real* history(std::size_t k, std::size_t number) {
    return &call_.history[static_cast<std::size_t>(call_.histories) *
                              (static_cast<std::size_t>(call_.history_of[k]) - 1) +
                          number];
  }

  void set(const SolverInput& input, std::size_t k, double canonical) {
    const double value = input.argument.solver.from_canonical(canonical);
    switch (input.source) {
    case Source::pressure:
      call_.normal[k] = static_cast<Real>(-value * node_area(k));
      break;
    case Source::speed: // across the force that was there before, and along the normal
      call_.slip[1][k] = static_cast<Real>(value / rate);
      call_.slip[2][k] = Real(3);
      break;
    case Source::slip:
      *history(k, 0) = static_cast<Real>(value);
      break;
    case Source::work:
      *history(k, 1) = static_cast<Real>(stress_.same() ? canonical : canonical * 1e3);
      break;
    case Source::peak_pressure:
      *history(k, 2) = static_cast<Real>(value);
      break;
    case Source::temperature:
      for (std::size_t n = 0; n < 5; ++n)
        call_.temperature[n * call_.node.size() + k] = static_cast<Real>(value);
      break;
    case Source::property:
      call_.constants[input.property - 1] = static_cast<Real>(value);
      break;
    default:
      break; // constants are in the source
    }
  }

  void* function_;
  std::vector<SolverInput> inputs_;
  SolverUnit stress_;
  UsrfrcCall<Real, Int> call_;
};

template <class Real, class Int>
void drive_as(const Built& built, const ExportRequest& request, std::size_t rows,
              std::span<const double* const> columns, std::span<double> tau) {
  Block<Real, Int> call(Library::address(built.library, "usrfrc_"), request);
  if (uses(call.inputs(), Source::temperature))
    *static_cast<Int*>(Library::address(built.library, "thropt_")) = 999;
  std::vector<std::size_t> asked;
  for (std::size_t row = 0; row < rows; ++row)
    if (posed(call.inputs(), columns, row, some_pressure)) asked.push_back(row);
  for (const std::vector<std::size_t>& group :
       call_groups(call.inputs(), std::move(asked), columns, block))
    call.run(group, columns, tau);
}

} // namespace

void drive(const Built& built, const ExportRequest& request, std::size_t rows,
           std::span<const double* const> columns, std::span<double> tau) {
  if (built.variant.name == "single")
    drive_as<float, std::int32_t>(built, request, rows, columns, tau);
  else
    drive_as<double, std::int64_t>(built, request, rows, columns, tau);
}

} // namespace frictab::lsdyna_usrfrc
