// Puts rows of states into blocks of contact points and calls VFRIC through its argument list.
#include "driver.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <numeric>

#include "call.h"
#include "codegen/compile.h"
#include "source.h"

namespace frictab::abaqus_vfric {

namespace {

constexpr std::size_t block = 136; // contact points per call, as the solver does

// Powers of two: dividing by them changes no bits, so what the routine sees is the row's state.
constexpr double time_increment = 0x1p-30;
double node_area(std::size_t node) {
  return std::ldexp(1.0, static_cast<int>(node % 4) - 2);
}

// Rows that agree in what is passed as a property can share a call.
std::vector<std::size_t> by_properties(const std::vector<SolverInput>& inputs, std::size_t rows,
                                       std::span<const double* const> columns) {
  std::vector<std::size_t> order(rows);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t c = inputs.size(); c-- > 0;)
    if (inputs[c].source == Source::property)
      std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::strong_order(columns[c][a], columns[c][b]) < 0;
      });
  return order;
}

bool same_properties(const std::vector<SolverInput>& inputs, std::span<const double* const> columns,
                     std::size_t a, std::size_t b) {
  for (std::size_t c = 0; c < inputs.size(); ++c)
    if (inputs[c].source == Source::property && columns[c][a] != columns[c][b]) return false;
  return true;
}

template <class Real> class Block {
public:
  Block(void* function, const ExportRequest& request)
      : function_(function), inputs_(solver_inputs(request, gives())),
        stress_(solver_unit("MPa", request.units)) {
    call_.properties.assign(property_count(inputs_), Real(0));
    call_.temperatures = true;
    call_.time_increment = Real(time_increment);
    for (const SolverInput& input : inputs_)
      call_.predefined = std::max(call_.predefined, static_cast<int>(input.field));
  }

  const std::vector<SolverInput>& inputs() const { return inputs_; }

  void run(std::span<const std::size_t> rows, std::span<const double* const> columns,
           std::span<double> tau) {
    const std::size_t count = rows.size();
    call_.resize(static_cast<int>(count), static_cast<int>(count) + 3);
    for (std::size_t k = 0; k < count; ++k) {
      call_.node[k] = static_cast<int>(count - k) + 2; // backwards, and not from the first node
      call_.area[node(k)] = static_cast<Real>(node_area(node(k)));
    }
    for (std::size_t c = 0; c < inputs_.size(); ++c)
      for (std::size_t k = 0; k < count; ++k)
        set(inputs_[c], k, inputs_[c].argument.solver.from_canonical(columns[c][rows[k]]));
    accumulate();
    call_.run(function_);
    for (std::size_t k = 0; k < count; ++k)
      tau[rows[k]] =
          stress_.to_canonical(-static_cast<double>(call_.tangential[2 * k]) / node_area(node(k)));
  }

private:
  std::size_t node(std::size_t k) const { return static_cast<std::size_t>(call_.node[k]) - 1; }

  void set(const SolverInput& input, std::size_t k, double value) {
    switch (input.source) {
    case Source::pressure:
      call_.normal[k] = static_cast<Real>(value * node_area(node(k)));
      break;
    case Source::speed:
      call_.slip[3 * k] = static_cast<Real>(value * time_increment);
      break;
    case Source::slip:
      call_.state[3 * node(k)] = static_cast<Real>(value);
      break;
    case Source::temperature:
      call_.temperature[k] = call_.temperature_main[k] = static_cast<Real>(value);
      break;
    case Source::field:
      call_.field[(input.field - 1) * static_cast<std::size_t>(call_.contacts) + k] =
          static_cast<Real>(value);
      call_.field_main[(input.field - 1) * static_cast<std::size_t>(call_.contacts) + k] =
          static_cast<Real>(value);
      break;
    case Source::property:
      call_.properties[input.property - 1] = static_cast<Real>(value);
      break;
    default:
      break; // constants are in the source
    }
  }

  // What was slipped before this increment, and a pressure for laws that do not ask for one.
  void accumulate() {
    const bool pressed = std::any_of(inputs_.begin(), inputs_.end(), [](const SolverInput& i) {
      return i.source == Source::pressure;
    });
    for (std::size_t k = 0; k < call_.node.size(); ++k) {
      call_.state[3 * node(k)] -= std::abs(call_.slip[3 * k]);
      if (!pressed) call_.normal[k] = Real(1);
    }
  }

  void* function_;
  std::vector<SolverInput> inputs_;
  SolverUnit stress_;
  VfricCall<Real> call_;
};

template <class Real>
void drive_as(void* function, const ExportRequest& request, std::size_t rows,
              std::span<const double* const> columns, std::span<double> tau) {
  Block<Real> call(function, request);
  const std::vector<std::size_t> order = by_properties(call.inputs(), rows, columns);
  for (std::size_t first = 0; first < rows;) {
    std::size_t last = first + 1;
    while (last < rows && last - first < block &&
           same_properties(call.inputs(), columns, order[first], order[last]))
      ++last;
    call.run(std::span(order).subspan(first, last - first), columns, tau);
    first = last;
  }
}

} // namespace

void drive(const Built& built, const ExportRequest& request, std::size_t rows,
           std::span<const double* const> columns, std::span<double> tau) {
  void* function = Library::address(built.library, "vfric_");
  if (built.variant.name == "single")
    drive_as<float>(function, request, rows, columns, tau);
  else
    drive_as<double>(function, request, rows, columns, tau);
}

} // namespace frictab::abaqus_vfric
