// Contact states of a simulation: whatever comes through is what a history promises.
#include <cmath>

#include "fuzz/target.h"
#include "fuzz/temporary_file.h"
#include "process/contact.h"

namespace frictab::fuzz::contact_target {
namespace {

void check(const process::ContactHistory& h) {
  promise(h.rows() > 0 && !h.time_s.empty(), "a history has contacts");
  promise(h.states.first_row.back() == h.rows(), "each facet has its rows");
  for (const std::vector<double>* column : {&h.area_mm2, &h.dt_s})
    promise(column->size() == h.rows(), "each column has all rows");
  const auto pressure = h.states.values("sigma_n_MPa"), speed = h.speed(),
             path = h.states.values("s_mm");
  for (std::size_t row = 0; row < h.rows(); ++row) {
    promise(pressure[row] > 0 && h.area_mm2[row] > 0, "only what touches counts");
    promise(speed[row] >= 0 && std::isfinite(path[row]), "speed and path are numbers");
    promise(h.dt_s[row] >= 0 && h.increment[row] < h.time_s.size(), "each row has its increment");
  }
}

void read(std::string_view bytes) {
  static const TemporaryFile file("contact.csv");
  file.write(bytes);
  process::ProcessOptions options;
  options.contact = {file.path().string()};
  check(process::read_contact(options));
}

const Registered<Target> registered([] { return Target{"contact", read}; });

} // namespace
} // namespace frictab::fuzz::contact_target
