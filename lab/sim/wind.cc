// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/wind.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/linalg/sparse_cholesky.h"
#include "core/linalg/symmetric_matrix.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

constexpr double kMaxViscosity_m2_per_s = 10.0;
constexpr double kMaxFlow_s = 3600.0;

// A velocity component on its face with the four neighbours of the same component, and the air's
// velocity there.
struct Stencil {
  double here, west, east, south, north;
  Velocity air;
};

// First-order upwind: the slope on the side that the air comes from.
double UpwindStep(double speed, double behind, double here, double ahead) {
  return speed > 0.0 ? here - behind : ahead - here;
}

// d(here)/dt = -(air . grad) here + nu laplace here, m/s^2.
double Acceleration(const Stencil& s, double resolution_m, double viscosity_m2_per_s) {
  const double advection = s.air.u_mps * UpwindStep(s.air.u_mps, s.west, s.here, s.east) +
                           s.air.v_mps * UpwindStep(s.air.v_mps, s.south, s.here, s.north);
  const double laplacian = s.west + s.east + s.south + s.north - 4.0 * s.here;
  return -advection / resolution_m + viscosity_m2_per_s * laplacian / (resolution_m * resolution_m);
}

// Beyond the raster lies only the outside of openings: there the component goes on unchanged.
Stencil StencilOfU(const MacField& f, Cell c) {
  const int top = f.geometry().height - 1;
  const double here = f.u(c.x, c.y);
  const double across =
      0.25 * (f.v(c.x - 1, c.y) + f.v(c.x, c.y) + f.v(c.x - 1, c.y + 1) + f.v(c.x, c.y + 1));
  return {here,
          f.u(c.x - 1, c.y),
          f.u(c.x + 1, c.y),
          c.y > 0 ? f.u(c.x, c.y - 1) : here,
          c.y < top ? f.u(c.x, c.y + 1) : here,
          {here, across}};
}

Stencil StencilOfV(const MacField& f, Cell c) {
  const int right = f.geometry().width - 1;
  const double here = f.v(c.x, c.y);
  const double across =
      0.25 * (f.u(c.x, c.y - 1) + f.u(c.x, c.y) + f.u(c.x + 1, c.y - 1) + f.u(c.x + 1, c.y));
  return {here,
          c.x > 0 ? f.v(c.x - 1, c.y) : here,
          c.x < right ? f.v(c.x + 1, c.y) : here,
          f.v(c.x, c.y - 1),
          f.v(c.x, c.y + 1),
          {across, here}};
}

bool IsWestOrEast(Side side) { return side == Side::kWest || side == Side::kEast; }

// The face of `opening` on the raster's edge, the parallel face one cell in, and the sign of inward
// flow.
struct OpeningFaces {
  double& outer;
  double& inner;
  double inward;
};

OpeningFaces FacesOf(const BoundaryFace& opening, MacField& f) {
  const auto [x, y] = opening.cell;
  const bool at_origin = opening.side == Side::kWest || opening.side == Side::kSouth;
  const int outer = at_origin ? 0 : 1;
  const int inner = 1 - outer;
  const double inward = at_origin ? 1.0 : -1.0;
  if (IsWestOrEast(opening.side)) return {f.u(x + outer, y), f.u(x + inner, y), inward};
  return {f.v(x, y + outer), f.v(x, y + inner), inward};
}

class WindSolver {
 public:
  WindSolver(const FlowDomain& domain, const WindOptions& options)
      : domain_(domain),
        options_(options),
        velocity_(domain.fluid.geometry()),
        unknown_(domain.fluid.geometry(), kNoUnknown) {}

  // Lists the faces and factorises the pressure equation. Before all else, once.
  absl::Status Prepare();
  double StableStep_s() const;
  absl::Status Step(double step_s);
  const MacField& velocity() const { return velocity_; }

 private:
  static constexpr int kNoUnknown = -1;

  void ListFaces();
  bool IsFluid(Cell cell) const { return domain_.fluid.At(cell, 0) != 0; }
  void Accelerate(double step_s);
  void OpenOutlets();
  absl::Status Project();
  void SubtractGradient();

  const FlowDomain& domain_;
  const WindOptions& options_;
  MacField velocity_;
  MacField before_;            // velocity at the beginning of the step
  std::vector<Cell> u_faces_;  // west face of the cell lies between two fluid cells
  std::vector<Cell> v_faces_;  // south face of the cell lies between two fluid cells
  std::vector<Cell> cells_;    // fluid cells, by unknown
  Grid<int> unknown_;          // row of the pressure equation
  SparseCholesky poisson_;
  std::vector<double> pressure_;  // times step / (density * cell edge): m/s
};

void WindSolver::ListFaces() {
  for (std::size_t i = 0; i < domain_.fluid.size(); ++i) {
    const Cell cell = domain_.fluid.geometry().CellAtIndex(i);
    if (!IsFluid(cell)) continue;
    unknown_[cell] = static_cast<int>(cells_.size());
    cells_.push_back(cell);
    if (IsFluid({cell.x - 1, cell.y})) u_faces_.push_back(cell);
    if (IsFluid({cell.x, cell.y - 1})) v_faces_.push_back(cell);
  }
}

// Rows of the Poisson equation: each face that pressure can act on adds p_c - p_n; p_n = 0 beyond
// outlets, which is what makes the matrix definite.
absl::Status WindSolver::Prepare() {
  ListFaces();
  std::vector<Triplet> triplets;
  const auto couple = [&](Cell cell, Cell neighbour) {
    const int row = unknown_[cell];
    const int column = unknown_[neighbour];
    triplets.insert(triplets.end(), {{row, row, 1.0}, {column, column, 1.0}, {row, column, -1.0}});
  };
  for (const Cell cell : u_faces_) couple(cell, {cell.x - 1, cell.y});
  for (const Cell cell : v_faces_) couple(cell, {cell.x, cell.y - 1});
  for (const BoundaryFace& opening : domain_.openings) {
    const int row = unknown_[opening.cell];
    if (!opening.inflow_mps) triplets.push_back({row, row, 1.0});
    const OpeningFaces faces = FacesOf(opening, velocity_);
    faces.outer = faces.inward * opening.inflow_mps.value_or(0.0);
  }
  pressure_.resize(cells_.size());
  PLUMESCOUT_ASSIGN_OR_RETURN(const SymmetricMatrix matrix,
                              SymmetricFromTriplets(static_cast<int>(cells_.size()), triplets));
  return poisson_.Factorize(matrix);
}

// Sufficient for explicit Euler with upwinding: the weight of the face's own old value,
// 1 - dt ((|u| + |v|) / h + 4 nu / h^2), stays positive.
double WindSolver::StableStep_s() const {
  const double h = domain_.fluid.geometry().resolution_m;
  const Velocity largest = velocity_.MaxMagnitudes();
  return options_.stability_share /
         ((largest.u_mps + largest.v_mps) / h + 4.0 * options_.viscosity_m2_per_s / (h * h));
}

void WindSolver::Accelerate(double step_s) {
  const double h = domain_.fluid.geometry().resolution_m;
  const double nu = options_.viscosity_m2_per_s;
  before_ = velocity_;
  for (const Cell c : u_faces_) {
    velocity_.u(c.x, c.y) += step_s * Acceleration(StencilOfU(before_, c), h, nu);
  }
  for (const Cell c : v_faces_) {
    velocity_.v(c.x, c.y) += step_s * Acceleration(StencilOfV(before_, c), h, nu);
  }
}

// Air leaves an outlet as fast as it arrives there. An eddy on the outlet may not suck air in.
void WindSolver::OpenOutlets() {
  for (const BoundaryFace& opening : domain_.openings) {
    if (opening.inflow_mps) continue;
    const OpeningFaces faces = FacesOf(opening, velocity_);
    faces.outer = faces.inward * std::min(0.0, faces.inward * faces.inner);
  }
}

// Makes the velocity divergence-free: laplace p = div velocity, velocity -= grad p.
absl::Status WindSolver::Project() {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    pressure_[i] = -velocity_.NetOutflow_mps(cells_[i]);
  }
  PLUMESCOUT_RETURN_IF_ERROR(poisson_.Solve(pressure_, pressure_));
  SubtractGradient();
  return absl::OkStatus();
}

void WindSolver::SubtractGradient() {
  const auto pressure = [this](Cell cell) {
    return pressure_[static_cast<std::size_t>(unknown_[cell])];
  };
  for (const Cell c : u_faces_) velocity_.u(c.x, c.y) -= pressure(c) - pressure({c.x - 1, c.y});
  for (const Cell c : v_faces_) velocity_.v(c.x, c.y) -= pressure(c) - pressure({c.x, c.y - 1});
  for (const BoundaryFace& opening : domain_.openings) {
    if (opening.inflow_mps) continue;
    const OpeningFaces faces = FacesOf(opening, velocity_);
    faces.outer -= faces.inward * pressure(opening.cell);
  }
}

absl::Status WindSolver::Step(double step_s) {
  Accelerate(step_s);
  OpenOutlets();
  return Project();
}

absl::Status Positive(const char* field, double value, double highest) {
  if (value > 0.0 && value <= highest) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("wind.", field, " = ", value, " must be in (0, ", highest, "]"));
}

}  // namespace

absl::Status Validate(const WindOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(
      Positive("viscosity_m2_per_s", options.viscosity_m2_per_s, kMaxViscosity_m2_per_s));
  PLUMESCOUT_RETURN_IF_ERROR(Positive("flow_s", options.flow_s, kMaxFlow_s));
  return Positive("stability_share", options.stability_share, 1.0);
}

absl::StatusOr<MacField> SolveWind(const FlowDomain& domain, const WindOptions& options,
                                   const FractionFn& progress) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  MacField mean(domain.fluid.geometry());
  if (domain.openings.empty()) return mean;
  WindSolver solver(domain, options);
  PLUMESCOUT_RETURN_IF_ERROR(solver.Prepare());
  double time_s = 0.0;
  double averaged_s = 0.0;
  while (time_s < options.flow_s) {
    const double step_s = solver.StableStep_s();
    PLUMESCOUT_RETURN_IF_ERROR(solver.Step(step_s));
    time_s += step_s;
    if (progress) progress(std::min(1.0, time_s / options.flow_s));
    if (time_s < options.flow_s / 2.0) continue;
    // Running mean: a mean of divergence-free fields is divergence-free.
    averaged_s += step_s;
    const double share = step_s / averaged_s;
    mean.AddScaled(mean, -share);
    mean.AddScaled(solver.velocity(), share);
  }
  return mean;
}

}  // namespace plumescout::lab
