// Continues and compares the state variables of routines for explicit solvers.
#include "codegen/explicit_account.h"

#include <algorithm>

#include <fmt/format.h>

#include "codegen/histories.h"

namespace frictab::codegen {

namespace {

constexpr std::size_t before_histories = 6, shown_last = 2;

}

ExplicitAccount::ExplicitAccount(DrivenPath& path, std::string name, std::size_t states)
    : path_(path), name_(std::move(name)), states_(states), histories_(history_count(path.inputs)),
      all_(before_histories + 2 * histories_ + shown_last) {}

bool ExplicitAccount::keeps_histories() const {
  return histories_ > 0 && keeps(all_ - shown_last);
}

double ExplicitAccount::summed(double value, std::size_t remainder) const {
  return keeps(remainder) ? value : path_.held(value);
}

void ExplicitAccount::add(ExplicitVariables& variables, const ExplicitChange& change) const {
  variables.slip = summed(variables.slip + change.slip, 5);
  variables.work = summed(variables.work + change.work, 6);
  variables.peak = std::max(variables.peak, path_.held(change.pressure));
  variables.outside += change.outside ? 1 : 0;
  variables.stress = change.stress;
  variables.mu = change.stress /
                 std::max(change.pressure, path_.stress.from_canonical(fortran::least_pressure));
}

void ExplicitAccount::compare_one(const double* st, std::size_t number, std::size_t remainder,
                                  const std::string& what, const std::string& unit,
                                  double expected) const {
  if (!keeps(number)) return;
  const bool has_rest = remainder > 0 && keeps(remainder);
  const std::string quantity = fmt::format("{}({}) {}", name_, number, what);
  path_.compare(quantity, unit, st[number - 1] + (has_rest ? st[remainder - 1] : 0), expected);
  // The number itself is the sum as the solver's precision holds it.
  if (has_rest) path_.compare(quantity + ", rounded", unit, st[number - 1], expected);
}

void ExplicitAccount::compare(const ExplicitVariables& variables, const ContactMemory& memory,
                              const double* st) const {
  const std::string length = path_.length.name, stress = path_.stress.name;
  compare_one(st, 1, 5, "slip", length, variables.slip);
  compare_one(st, 2, 6, "friction work", stress + "*" + length, variables.work);
  compare_one(st, 3, 0, "peak pressure", stress, variables.peak);
  compare_one(st, 4, 0, "increments outside", "1", variables.outside);
  if (keeps_histories()) {
    const std::vector<double> kept = memory.variables(path_.request.units);
    const std::vector<HistoryState> known = history_states(path_.inputs, path_.request.units);
    for (std::size_t h = 0; h < kept.size(); ++h)
      compare_one(st, before_histories + h + 1, before_histories + histories_ + h + 1,
                  known[h].name, known[h].unit, kept[h]);
  }
  if (!keeps(all_)) return;
  compare_one(st, all_ - 1, 0, "tau_R", stress, variables.stress);
  compare_one(st, all_, 0, "mu", "1", variables.mu);
}

} // namespace frictab::codegen
