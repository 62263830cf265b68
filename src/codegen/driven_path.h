// Drives a generated routine over increments, as its solver would, and compares all that it returns
// and remembers with an account of its own. The account of a target is written from the definition
// of its state variables (recipe.json) and from the table; it shares no text with the routine.
//
// The call itself is in templates/<vendor>/<target>/driver.f, a subroutine
//
//   ftincr(n, npar, par, nv, v, ns, st, np, prop, nf, field, nout, out)
//     integer*4 n, npar, nv, ns, np, nf, nout
//     real*8 par(npar), v(nv,n), st(ns,n), prop(np), field(2*nf,n), out(nout,n)
//
// that calls the routine for one increment of n contact points. par: numbers that all points share;
// v: those of a point; st: its state variables, in and out; prop: the deck's properties; field:
// field variables of both surfaces; out: what the routine returns. Their meaning is that of the
// target.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "codegen/coefficient.h"
#include "codegen/contact_memory.h"
#include "codegen/exporter.h"
#include "codegen/path_result.h"
#include "codegen/solver_inputs.h"
#include "codegen/solver_units.h"
#include "core/random.h"
#include "table/outside.h"

namespace frictab::codegen {

// All that a target's account knows about a contact point in one increment, in canonical units
// except for properties and fields.
struct GivenStates {
  double pressure = 0;
  double speed = 0;
  double slip = 0;
  double work = 0;
  double peak_pressure = 0;
  std::optional<double> temperature = {}; // empty: the solver gives none
  double flow_stress = 0;
  double expansion = 1;
  double area = 0;
  std::span<const double> properties = {}; // of the deck, in its units
  std::vector<double> fields = {};         // at the point, in the solver's units
  const ContactMemory* memory = nullptr;   // null: nothing is kept
  std::optional<double> direction = {};    // of slip, in degrees; empty: the solver gives none
};

// Target of the next increment of a point, in canonical units.
struct WantedStates {
  double pressure = 0;
  double speed = 0;
  double slip = 0;
  double temperature = 0;
  double flow_stress = 0;
  double expansion = 1;
  std::vector<double> fields = {}; // solver's units
};

class DrivenPath {
public:
  DrivenPath(const Built& built, const ExportRequest& request,
             const std::vector<SolverInput>& inputs, PathOptions options);
  DrivenPath(const DrivenPath&) = delete;
  DrivenPath& operator=(const DrivenPath&) = delete;

  const ExportRequest& request;
  const std::vector<SolverInput>& inputs;
  const SolverUnit stress, length, speed, time, celsius;
  Random random;

  std::size_t increments() const { return options_.increments; }
  double held(double value) const; // as the solver's precision holds it

  // States for a point in increment `i`: inside the range mostly, beyond each end in turn.
  WantedStates wanted(std::size_t point, std::size_t i);
  // Seconds in which points at usual speeds slide through the range of s_mm in about three quarters
  // of the path.
  double time_increment();
  // The deck's properties, inside their ranges, in the solver's units.
  std::vector<double> usual_properties();
  // Chooses them for increment `i`; in every ninth the deck gives none. Returns the factor of time
  // that property number `factor_property` then has (0: there is none), else 1.
  double choose_properties(std::vector<double>& properties, std::size_t i,
                           std::size_t factor_property = 0);

  // The direction of a slip as the law takes it, by its definition in codegen/sliding_direction.h:
  // from components in the surface, or in global axes on a surface of this normal.
  double direction(double along, double across) const;
  double direction(const Axis& slip, const Axis& normal) const;

  // The law's states, in the order of the table's inputs; the second takes the law itself at the
  // pressure `asked`, while histories follow the one that is given.
  std::vector<double> states(const GivenStates& given) const;
  std::vector<double> states_at(const GivenStates& given, double asked) const;
  // The contact temperature that histories follow; 0 if none does.
  double followed_temperature(const GivenStates& given) const;
  double tau(std::span<const double> states) const; // MPa, by the table itself
  // The states without contact: a side that refuses answers by its end there.
  std::vector<double> without_contact(std::vector<double> states) const;
  // mu, m or tau_R (MPa), as fortran::coefficient() defines it.
  double coefficient(const GivenStates& given, fortran::Coefficient kind) const;
  bool is_outside(std::span<const double> states) const;
  bool is_refused(std::span<const double> states) const; // the routine would end the analysis

  // Numbers of one call of ftincr; each array but `par` and `properties` has as many per point.
  struct Call {
    std::size_t points = 0;
    std::vector<double> par, v, st, properties, fields, out;
  };
  void run(Call& call);

  // Compares one number. Rounding is allowed, relative to `expected` or to a thousandth of the
  // largest so far. NaN equals NaN.
  void compare(const std::string& quantity, const std::string& unit, double got, double expected);
  // Compares a derivative with difference quotients of `value` on either side of `at`, since a law
  // may have a kink there. `scale`: the size of what it is the derivative by.
  void compare_slope(const std::string& quantity, const std::string& unit, double got,
                     const std::function<double(double)>& value, double at, double scale);

  const PathResult& result() const { return result_; }

  // Takes an account, which knows one increment, along a share of the path.
  template <class Account> void drive(Account account, double share) {
    const auto last = static_cast<std::size_t>(share * static_cast<double>(options_.increments));
    for (std::size_t i = 0; i < last; ++i)
      account.increment(i);
  }
  // Takes one along the path, and another at a higher pace: every history passes the end of its
  // range.
  template <class Make> void drive_at_both_paces(const Make& make) {
    drive(make(), 1);
    pace_ = 12;
    drive(make(), 1.0 / 3);
    pace_ = 1;
  }

private:
  PathFigure& figure(const std::string& quantity, const std::string& unit);
  double inside(const std::string& name);
  double beyond(const std::string& name, bool above);
  std::pair<double, double> range(const std::string& name) const;

  PathOptions options_;
  double pace_ = 1; // multiplies all times
  bool single_;
  table::TableFunction table_;
  std::vector<table::AxisEnds> ends_;
  ContactMemory no_memory_;
  const Turn turn_;
  Axis reference_ = {1, 0, 0};
  void* call_;
  PathResult result_;
};

} // namespace frictab::codegen
