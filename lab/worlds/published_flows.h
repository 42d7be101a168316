// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace plumescout::lab {

// What others have measured and computed for flows that every solver is tried on.

struct ProfilePoint {
  double at = 0.0;     // share of the cavity's edge
  double speed = 0.0;  // share of the lid's speed
  // The value stands out of the smooth curve through its neighbours, and of every converged
  // solution: taken to be a misprint. Shown, but not counted.
  bool misprint = false;
};

// U. Ghia, K. N. Ghia, C. T. Shin: High-Re solutions for incompressible flow using the
// Navier-Stokes equations and a multigrid method. J. Comput. Phys. 48 (1982) 387-411, tables I and
// II, on 129 x 129 points. Square cavity, the lid on top slides in the direction of x.
struct GhiaCavity {
  double reynolds = 0.0;           // lid's speed * edge / nu
  std::array<ProfilePoint, 15> u;  // along x on the vertical centre line, over y
  std::array<ProfilePoint, 15> v;  // along y on the horizontal centre line, over x
};

inline constexpr std::array<GhiaCavity, 2> kGhiaCavities = {{
    {100.0,
     {{{0.0547, -0.03717},
       {0.0625, -0.04192},
       {0.0703, -0.04775, true},
       {0.1016, -0.06434},
       {0.1719, -0.10150},
       {0.2813, -0.15662},
       {0.4531, -0.21090},
       {0.5000, -0.20581},
       {0.6172, -0.13641},
       {0.7344, 0.00332},
       {0.8516, 0.23151},
       {0.9531, 0.68717},
       {0.9609, 0.73722},
       {0.9688, 0.78871},
       {0.9766, 0.84123}}},
     {{{0.0625, 0.09233},
       {0.0703, 0.10091},
       {0.0781, 0.10890},
       {0.0938, 0.12317},
       {0.1563, 0.16077},
       {0.2266, 0.17507},
       {0.2344, 0.17527},
       {0.5000, 0.05454},
       {0.8047, -0.24533},
       {0.8594, -0.22445},
       {0.9063, -0.16914},
       {0.9453, -0.10313},
       {0.9531, -0.08864},
       {0.9609, -0.07391},
       {0.9688, -0.05906}}}},
    {400.0,
     {{{0.0547, -0.08186},
       {0.0625, -0.09266},
       {0.0703, -0.10338},
       {0.1016, -0.14612},
       {0.1719, -0.24299},
       {0.2813, -0.32726},
       {0.4531, -0.17119},
       {0.5000, -0.11477},
       {0.6172, 0.02135},
       {0.7344, 0.16256},
       {0.8516, 0.29093},
       {0.9531, 0.55892},
       {0.9609, 0.61756},
       {0.9688, 0.68439},
       {0.9766, 0.75837}}},
     {{{0.0625, 0.18360},
       {0.0703, 0.19713},
       {0.0781, 0.20920},
       {0.0938, 0.22965},
       {0.1563, 0.28124},
       {0.2266, 0.30203},
       {0.2344, 0.30174},
       {0.5000, 0.05186},
       {0.8047, -0.38598},
       {0.8594, -0.44993},
       {0.9063, -0.23827, true},
       {0.9453, -0.22847},
       {0.9531, -0.19254},
       {0.9609, -0.15663},
       {0.9688, -0.12146}}}},
}};

// Extremes of the same profiles at Re = 100 by a spectral method: O. Botella, R. Peyret: Benchmark
// spectral results on the lid-driven cavity flow. Computers & Fluids 27 (1998) 421-433. Ghia's
// table lies up to 0.009 off them.
inline constexpr double kCavityLeastU100 = -0.2140424;
inline constexpr double kCavityGreatestV100 = 0.1795728;
inline constexpr double kCavityLeastV100 = -0.2538030;

// Where the flow behind a step meets the wall again, in heights of the step: E. Erturk: Numerical
// solutions of 2-D steady incompressible flow over a backward-facing step, part I. Computers &
// Fluids 37 (2008) 633-655; the channel is twice as high behind the step as before it. Below about
// Re = 400 the measurements of Armaly et al., J. Fluid Mech. 127 (1983) 473-496, agree with such
// two-dimensional solutions.
struct Reattachment {
  double reynolds = 0.0;  // mean speed before the step * 2 * height there / nu
  double length = 0.0;    // over the step's height
};
inline constexpr std::array<Reattachment, 2> kReattachments = {{{100.0, 2.922}, {200.0, 4.982}}};

}  // namespace plumescout::lab
