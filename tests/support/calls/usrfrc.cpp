// USRFRC's argument list as the Fortran compiler passes it: pointers, then the length of SIDE.
#include "support/calls/usrfrc.h"

#include <numeric>
#include <string>

namespace frictab::calls {

template <class Real, class Int> void UsrfrcCall<Real, Int>::resize(std::size_t places) {
  const auto count = [](std::vector<Int>& list, std::size_t n, Int first) {
    list.resize(n);
    std::iota(list.begin(), list.end(), first);
  };
  count(active, places, 1);
  count(history_of, places, 1);
  count(node, places, 1);
  count(segment, places, 1);
  for (Int c = 0; c < 4; ++c)
    count(corner[c], places, static_cast<Int>(places) * (c + 1) + 1);
  for (auto* zero : {&slip[0], &slip[1], &slip[2], &direction[0], &direction[1], &force[0],
                     &force[1], &force[2], &normal, &s, &t, &stiffness})
    zero->assign(places, Real(0));
  direction[2].assign(places, Real(1));
  area.assign(places, Real(1));
  scale.assign(2 * places, Real(1));
  before.assign(5 * places, Real(0));
  for (std::size_t k = 0; k < places; ++k)
    before[5 * k + 2] = Real(0x1p60);
  history.assign(static_cast<std::size_t>(histories) * places, Real(0));
  last_segment.assign(places, 0);
  temperature.assign(5 * places, Real(0));
}

template <class Real, class Int> void UsrfrcCall<Real, Int>::run(void* function) {
  // IISV5 follows SIDE, whose length (gfortran 8 and later: size_t, by value) is the last argument.
  using I = Int*;
  using R = Real*;
  using Usrfrc = void (*)(I, R, I, R, I, R, R, R, R, I, I, I, I, I, R, R, R, R, R, R, R, R, R, R, R,
                          I, R, char*, I, I, R, R, R, R, R, R, R, R, R, I, R, R, R, R, R, I, R, R,
                          I, I, R, I, I, R, R, R, I, I, R, I, R, R, std::size_t);
  Int interface = 1, cycle = 1, inputs = static_cast<Int>(constants.size());
  Int active_count = static_cast<Int>(active.size()), nodes = static_cast<Int>(temperature.size());
  Int elements = 1;
  Real time = 0, step = 1 / rate, zero = 0;
  std::vector<Int> no_integers(temperature.size() + 1, 0);
  std::vector<Real> no_reals(4 * active.size() + temperature.size() + 1, Real(0));
  std::string side = "master";
  R none = no_reals.data();
  reinterpret_cast<Usrfrc>(function)(
      &interface, &time, &cycle, &step, node.data(), area.data(), none, none, none, segment.data(),
      corner[0].data(), corner[1].data(), corner[2].data(), corner[3].data(), none, none, none,
      none, none, none, normal.data(), slip[0].data(), slip[1].data(), slip[2].data(), &rate,
      &inputs, constants.data(), side.data(), active.data(), &active_count, direction[0].data(),
      direction[1].data(), direction[2].data(), &zero, &zero, &zero, &zero, &zero, before.data(),
      last_segment.data(), force[0].data(), force[1].data(), force[2].data(), s.data(), t.data(),
      history_of.data(), stiffness.data(), scale.data(), &nodes, no_integers.data(), none,
      no_integers.data(), no_integers.data(), temperature.data(), none, none, no_integers.data(),
      &histories, history.data(), &elements, none, &implicit_factor, side.size());
}

template struct UsrfrcCall<float, std::int32_t>;
template struct UsrfrcCall<double, std::int64_t>;

} // namespace frictab::calls
