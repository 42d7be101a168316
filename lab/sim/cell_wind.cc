// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/cell_wind.h"

#include <cstddef>
#include <vector>

#include "core/linalg/symmetric_matrix.h"
#include "core/types/status_macros.h"
#include "lab/linalg/sparse_cholesky.h"

namespace plumescout::lab {
namespace {

// Face between two free cells: the western and eastern, or the southern and northern.
struct InnerFace {
  Cell low;
  Cell high;
  bool vertical;  // the wind through it is u

  double& Of(MacField& wind) const {
    return vertical ? wind.u(high.x, high.y) : wind.v(high.x, high.y);
  }
};

std::vector<InnerFace> InnerFaces(const Grid<CellState>& occupancy) {
  std::vector<InnerFace> faces;
  const auto is_free = [&](Cell cell) {
    return occupancy.At(cell, CellState::kOccupied) == CellState::kFree;
  };
  for (std::size_t i = 0; i < occupancy.size(); ++i) {
    const Cell cell = occupancy.geometry().CellAtIndex(i);
    if (!is_free(cell)) continue;
    const Cell west{cell.x - 1, cell.y};
    const Cell south{cell.x, cell.y - 1};
    if (is_free(west)) faces.push_back({west, cell, true});
    if (is_free(south)) faces.push_back({south, cell, false});
  }
  return faces;
}

// Pressure equation: nothing holds the pressure of a closed space as a whole, so a millionth of it
// is asked to be 0 everywhere. What divergence that leaves is a millionth as well.
absl::StatusOr<SymmetricMatrix> PoissonMatrix(const std::vector<InnerFace>& faces,
                                              const Grid<int>& unknown, int unknowns) {
  constexpr double kHold = 1e-6;
  std::vector<Triplet> triplets;
  for (int i = 0; i < unknowns; ++i) triplets.push_back({i, i, kHold});
  for (const InnerFace& face : faces) {
    const int low = unknown[face.low];
    const int high = unknown[face.high];
    triplets.insert(triplets.end(), {{low, low, 1.0}, {high, high, 1.0}, {high, low, -1.0}});
  }
  return SymmetricFromTriplets(unknowns, triplets);
}

}  // namespace

WindField CellWind(const MacField& wind, const Grid<CellState>& occupancy) {
  const GridGeometry& geometry = occupancy.geometry();
  WindField centres{Grid<float>(geometry), Grid<float>(geometry)};
  for (std::size_t i = 0; i < occupancy.size(); ++i) {
    if (occupancy[i] != CellState::kFree) continue;
    const Velocity velocity = wind.AtCenter(geometry.CellAtIndex(i));
    centres.u_mps[i] = static_cast<float>(velocity.u_mps);
    centres.v_mps[i] = static_cast<float>(velocity.v_mps);
  }
  return centres;
}

MacField FaceWind(const WindField& wind, const Grid<CellState>& occupancy) {
  MacField field(occupancy.geometry());
  for (const InnerFace& face : InnerFaces(occupancy)) {
    const Grid<float>& component = face.vertical ? wind.u_mps : wind.v_mps;
    face.Of(field) = 0.5 * (component[face.low] + component[face.high]);
  }
  return field;
}

absl::StatusOr<MacField> WithoutDivergence(MacField wind, const Grid<CellState>& occupancy) {
  const GridGeometry& geometry = occupancy.geometry();
  Grid<int> unknown(geometry);
  std::vector<double> pressure;  // by unknown; first the net inflow
  for (std::size_t i = 0; i < occupancy.size(); ++i) {
    if (occupancy[i] != CellState::kFree) continue;
    unknown[i] = static_cast<int>(pressure.size());
    pressure.push_back(-wind.NetOutflow_mps(geometry.CellAtIndex(i)));
  }
  if (pressure.empty()) return wind;
  const std::vector<InnerFace> faces = InnerFaces(occupancy);
  PLUMESCOUT_ASSIGN_OR_RETURN(const SymmetricMatrix matrix,
                              PoissonMatrix(faces, unknown, static_cast<int>(pressure.size())));
  SparseCholesky poisson;
  PLUMESCOUT_RETURN_IF_ERROR(poisson.Factorize(matrix));
  PLUMESCOUT_RETURN_IF_ERROR(poisson.Solve(pressure, pressure));
  const auto at = [&](Cell cell) { return pressure[static_cast<std::size_t>(unknown[cell])]; };
  for (const InnerFace& face : faces) face.Of(wind) -= at(face.high) - at(face.low);
  return wind;
}

}  // namespace plumescout::lab
