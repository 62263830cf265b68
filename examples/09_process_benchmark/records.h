// What goes into and comes out of the finite elements, without their headers.
#pragma once

#include "friction.h"

// One contact point after a step; `area` is what it stands for now, 0 where nothing touches.
struct ContactRecord {
  double r, z; // mm, now
  bool touches;
  double area; // mm^2
  ContactState state;
  double tau, velocity;
  unsigned outside;
};

struct Energies { // N mm, sums since the start
  double plastic = 0, friction = 0, elastic = 0;
};

// Numbers of the heat equation (heat.h).
struct HeatData {
  bool on = false;
  double tool = 20;         // degC
  double capacity = 3.6;    // MPa/K = N/(mm^2 K), steel
  double conductivity = 45; // N/(s K) = W/(m K)
  double film = 20;         // N/(mm s K) = kW/(m^2 K), between billet and tool under pressure
  double plastic_share = 0.9;
};
