// Puts rows of states into blocks of contact points, as the targets for Abaqus/Explicit call their
// routines.
#pragma once

#include "codegen/compile.h"
#include "codegen/solver_inputs.h"

namespace frictab::abaqus {

// One block of contact points behind a routine's argument list. Values are in the solver's units;
// points, fields and properties count from 0.
class ExplicitBlock {
public:
  virtual ~ExplicitBlock() = default;
  // Makes room; nothing of an earlier call is left but the properties.
  virtual void resize(std::size_t points, std::size_t fields) = 0;
  virtual void property(std::size_t number, double value) = 0;
  virtual void pressure(std::size_t point, double value) = 0;
  virtual void speed(std::size_t point, double value) = 0;
  virtual void temperature(std::size_t point, double value) = 0;
  virtual void field(std::size_t number, std::size_t point, double value) = 0;
  // Slip after the increment, work, peak pressure and further histories before it; after `speed`.
  virtual void history(std::size_t, double /*slip*/, double /*work*/, double /*peak*/,
                       std::span<const double> /*further*/) {}
  virtual void run() = 0;
  virtual double stress(std::size_t point) const = 0; // tau_R
};

// Powers of two: dividing by them changes no bits, so what a routine sees is the row's state.
inline constexpr double driver_increment = 0x1p-30;
double driver_area(std::size_t point);

// State variables of one point (explicit.h) but 4, the slip of the increment taken off.
template <class Real>
void put_history(Real* states, double slip_before, double work, double peak,
                 std::span<const double> further) {
  const auto put = [states](std::size_t at, std::size_t rest, double value) {
    states[at] = static_cast<Real>(value);
    states[rest] = static_cast<Real>(value - static_cast<double>(states[at]));
  };
  put(0, 4, slip_before);
  put(1, 5, work);
  states[2] = static_cast<Real>(peak);
  for (std::size_t i = 0; i < further.size(); ++i)
    put(6 + i, 6 + further.size() + i, further[i]);
}

// Rows whose history cannot be (a peak below the present pressure, two values of one slip) keep
// what is in `tau`.
void drive_explicit(ExplicitBlock& block, const SolverGives& gives, const ExportRequest& request,
                    std::size_t rows, std::span<const double* const> columns,
                    std::span<double> tau);

// As Exporter::drive, for a routine of either precision behind Block<Real>(function, inputs).
template <template <class> class Block>
void drive_blocks(const char* symbol, const Built& built, const SolverGives& gives,
                  const ExportRequest& request, std::size_t rows,
                  std::span<const double* const> columns, std::span<double> tau) {
  void* function = Library::address(built.library, symbol);
  const std::vector<SolverInput> inputs = solver_inputs(request, gives);
  const auto drive = [&](auto block) { drive_explicit(block, gives, request, rows, columns, tau); };
  if (built.variant.name == "single")
    drive(Block<float>(function, inputs));
  else
    drive(Block<double>(function, inputs));
}

} // namespace frictab::abaqus
