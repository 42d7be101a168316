// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/projection.h"

#include "core/linalg/symmetric_matrix.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {

absl::StatusOr<Projection> Projection::Create(const FlowDomain& domain, const FreeFaces& free) {
  const FlowParts parts = FindFlowParts(domain, free);
  PLUMESCOUT_RETURN_IF_ERROR(CheckContinuity(parts));
  Projection projection;
  projection.ListUnknowns(domain, free);
  PLUMESCOUT_RETURN_IF_ERROR(projection.Factorize(parts));
  return projection;
}

void Projection::ListUnknowns(const FlowDomain& domain, const FreeFaces& free) {
  constexpr int kNone = -1;
  const MacField numbering(domain.fluid.geometry());
  unknown_ = Grid<int>(domain.fluid.geometry(), kNone);
  for (std::size_t i = 0; i < domain.fluid.size(); ++i) {
    if (domain.fluid[i] == 0) continue;
    unknown_[i] = static_cast<int>(cells_.size());
    cells_.push_back(domain.fluid.geometry().CellAtIndex(i));
  }
  const auto row = [this](Cell cell) { return static_cast<std::uint32_t>(unknown_[cell]); };
  const auto index = [&](const Face& face) {
    return static_cast<std::uint32_t>(IndexOf(face, numbering));
  };
  for (const Face& face : free.all()) {
    links_.push_back({index(face), row(face.behind()), row(face.ahead)});
  }
  for (const BoundaryFace& opening : domain.openings) {
    if (opening.inflow_mps) continue;
    const OpeningFaces faces = FacesOf(opening);
    outlets_.push_back({index(faces.outer), row(opening.cell), faces.inward});
  }
  pressure_mps_.resize(cells_.size());
}

// Each face that pressure acts on adds p_c - p_n to the rows of its cells. p_n = 0 beyond outlets,
// or beyond the made-up face, is what makes the matrix definite.
absl::Status Projection::Factorize(const FlowParts& parts) {
  std::vector<Triplet> triplets;
  const auto add = [&](std::uint32_t row, std::uint32_t column, double value) {
    triplets.push_back({static_cast<int>(row), static_cast<int>(column), value});
  };
  for (const Link& link : links_) {
    add(link.behind, link.behind, 1.0);
    add(link.ahead, link.ahead, 1.0);
    add(link.ahead, link.behind, -1.0);  // the lower triangle: unknowns grow along both axes
  }
  for (const Outlet& outlet : outlets_) add(outlet.unknown, outlet.unknown, 1.0);
  for (const FlowPart& part : parts.parts) {
    const auto row = static_cast<std::uint32_t>(unknown_[part.first]);
    if (!part.has_outlet) add(row, row, 1.0);
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const SymmetricMatrix matrix,
                              SymmetricFromTriplets(static_cast<int>(cells_.size()), triplets));
  return poisson_.Factorize(matrix);
}

absl::Status Projection::Project(MacField& velocity) {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    pressure_mps_[i] = -velocity.NetOutflow_mps(cells_[i]);
  }
  PLUMESCOUT_RETURN_IF_ERROR(poisson_.Solve(pressure_mps_, pressure_mps_));
  const std::span<double> speeds = velocity.values();
  for (const Link& link : links_) {
    speeds[link.face] -= pressure_mps_[link.ahead] - pressure_mps_[link.behind];
  }
  for (const Outlet& outlet : outlets_) {
    speeds[outlet.face] -= outlet.inward * pressure_mps_[outlet.unknown];
  }
  return absl::OkStatus();
}

}  // namespace plumescout::lab
