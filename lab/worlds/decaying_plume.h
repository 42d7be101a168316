// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumescout::lab {

// Mean concentration around a point source of particles that wind carries along, that diffuse alike
// in all three directions and that live for a while: the steady state of
//
//   u dc/dx = D laplace(c) - c / tau + rate delta(x),
//
// which is, at the distance r from the source and x downwind of it,
//
//   c = rate / (4 pi D r) exp(u x / (2 D) - r / lambda),   lambda = sqrt(D tau / (1 + u^2 tau / (4
//   D))).
//
// It is the field's model for "wind, diffusivity and average particle lifetime": Vergassola,
// Villermaux and Shraiman, Infotaxis, Nature 445 (2007), and since then most work on finding
// sources with robots. Near the axis it is the Gaussian plume of variance 2 D x / u, thinned by
// exp(-x / (u tau)).
struct DecayingPlume {
  double wind_mps = 3.0;              // u, >= 0
  double diffusivity_m2_per_s = 1.0;  // D, > 0
  double lifetime_s = 8.0;            // tau, > 0
  // Radius of the particles that leave the source, > 0: within it the concentration no longer grows
  // as 1 / r. Half a metre is half a cell of the map, which could show no more.
  double particle_radius_m = 0.5;

  // Concentration at a release rate of 1, s/m^3. `crosswind_m` is the distance from the axis, in
  // any direction.
  double PerRate_s_per_m3(double downwind_m, double crosswind_m) const;
};

}  // namespace plumescout::lab
