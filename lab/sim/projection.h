// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "lab/linalg/sparse_cholesky.h"
#include "lab/sim/flow_faces.h"
#include "lab/sim/flow_parts.h"
#include "lab/sim/mac_field.h"

namespace plumescout::lab {

// Takes the divergence out of a velocity field (Chorin 1968): solves laplace p = div velocity, with
// p = 0 beyond outlets and no gradient through walls, inlets and fans, and subtracts grad p. A part
// without an outlet has p = 0 beyond one more, made-up face, through which nothing flows because
// nothing is left to. Factorised once; a projection costs two passes over the factor.
class Projection {
 public:
  // kInvalidArgument from CheckContinuity; the errors of SparseCholesky.
  static absl::StatusOr<Projection> Create(const FlowDomain& domain, const FreeFaces& free);

  // After it every fluid cell has no net outflow, up to rounding.
  absl::Status Project(MacField& velocity);

 private:
  // Face between two unknowns.
  struct Link {
    std::uint32_t face, behind, ahead;
  };
  struct Outlet {
    std::uint32_t face, unknown;
    double inward;
  };

  void ListUnknowns(const FlowDomain& domain, const FreeFaces& free);
  absl::Status Factorize(const FlowParts& parts);

  std::vector<Cell> cells_;  // by unknown
  Grid<int> unknown_;
  std::vector<Link> links_;
  std::vector<Outlet> outlets_;
  SparseCholesky poisson_;
  std::vector<double> pressure_mps_;  // times step / (density * cell edge)
};

}  // namespace plumescout::lab
