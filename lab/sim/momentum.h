// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lab/sim/flow_domain.h"
#include "lab/sim/flow_faces.h"
#include "lab/sim/mac_field.h"

namespace plumescout::lab {

// The forces on air other than pressure, in finite volumes around the faces:
//   d velocity / dt = -div(velocity velocity) + nu laplace velocity
//
//   advection  what flows through a side of a volume is interpolated from its upwind side to second
//              order, with van Leer's limiter (1974): no new extrema, so no wiggles at jets
//   walls      no slip, on the wall itself: the speed beyond a wall that runs along the face is the
//              wall's less the face's mirror image
//   inlets     air comes in at right angles
//   outlets    what flows out is carried on; what flows in was at rest outside and pays for its
//              speed with pressure (Bernoulli)
class Momentum {
 public:
  Momentum(const FlowDomain& domain, const FreeFaces& free);

  // Faces whose speed changes, as indices into MacField::values(): the free ones and the outlets.
  const std::vector<std::uint32_t>& moving() const { return moving_; }

  // rate[face] = d speed / dt, m/s^2, of the moving faces; meaningless for others.
  // REQUIRES: `velocity` is of the domain; `rate` has as many values as it.
  void Rate(const MacField& velocity, double viscosity_m2_per_s, std::span<double> rate);

 private:
  // Side between the volumes of two parallel neighbours. All are indices of faces, or of ghosts
  // behind them: speeds beyond walls and edges.
  struct Link {
    std::uint32_t far_behind, behind, ahead, far_ahead;
    std::uint32_t carrier_a, carrier_b;  // the mean of their speeds carries air through the side
  };
  // speed = offset_mps + factor * speed of the face
  struct Ghost {
    std::uint32_t face;
    double factor;
    double offset_mps;
  };
  struct Outlet {
    std::uint32_t outer, inner;
    double inward;
  };
  class Builder;

  double resolution_m_;
  std::vector<std::uint32_t> moving_;
  std::vector<Link> links_;
  std::vector<Ghost> ghosts_;
  std::vector<Outlet> outlets_;
  std::vector<double> speeds_;  // of faces, then of ghosts
  std::vector<double> rates_;   // with room for what links say of ghosts
};

}  // namespace plumescout::lab
