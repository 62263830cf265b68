// The return mapping and the contact as nonlinear operators of GetFEM's assembly language:
//   Nominal_stress(H, pressure, history)              the vector P = (rr, rz, zr, zz, tt),
//   Die_traction(H, u, X, u_before, normal, memory)   the vector t = (r, z),
// with H = F - I as the vector (u_r,r  u_r,z  u_z,r  u_z,z  u_r/r). The last arguments are data of
// the integration points (pack_history). GetFEM asks for derivatives by the arguments that depend
// on an unknown; Dual gives them.
#pragma once

#include "contact.h"

constexpr unsigned history_size = 6, memory_size = history_size + 1; // memory: history, slid

template <class Vector> History unpack_history(const Vector& from, std::size_t first) {
  return {{from[first], from[first + 1], from[first + 2], from[first + 3]},
          from[first + 4],
          from[first + 5]};
}

template <class Vector> void pack_history(const History& h, Vector& to, std::size_t first) {
  const double values[] = {h.plastic.rr, h.plastic.zz, h.plastic.rz,
                           h.plastic.tt, h.strain,     h.temperature};
  for (unsigned i = 0; i < history_size; ++i)
    to[first + i] = values[i];
}

// Registers both operators under their names; they read `setting` whenever they are evaluated.
void register_operators(const ContactSetting& setting);
