// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/advection_diffusion.h"

#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>

#include "lab/sim/ageing_depth.h"
#include "lab/sim/concentration_slice.h"
#include "lab/sim/gas_space.h"

namespace plumescout::lab {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
constexpr int kNoUnknown = -1;

// Assembles the matrix: what leaves each cell in 1/s, by the cells' concentrations.
class Transport {
 public:
  Transport(const LayoutRaster& raster, const MacField& wind, double diffusivity_m2_per_s);

  const std::vector<Cell>& cells() const { return cells_; }  // by unknown
  // Whether gas can leave: to the outside, or upwards.
  bool open() const { return open_; }
  // The matrix with a loss of `rate_per_s` in every cell.
  Matrix MatrixWithLoss(double rate_per_s) const;

 private:
  // A face between two cells; `speed_mps` from `behind` to `ahead`, not negative.
  struct Face {
    Cell behind;
    Cell ahead;
    double speed_mps;
  };

  void AddFace(const Face& face);
  void AddTerm(Cell of, Cell by, double rate_per_s);
  GasSpace SpaceAt(Cell cell) const { return spaces_.At(cell, GasSpace::kOutside); }

  Grid<GasSpace> spaces_;
  Grid<int> unknown_;
  std::vector<Cell> cells_;
  double resolution_m_;
  double diffusion_per_s_;  // D / h^2
  bool open_ = false;
  std::vector<Eigen::Triplet<double>> terms_;
};

Transport::Transport(const LayoutRaster& raster, const MacField& wind, double diffusivity_m2_per_s)
    : spaces_(GasSpaces(raster)),
      unknown_(spaces_.geometry(), kNoUnknown),
      resolution_m_(spaces_.geometry().resolution_m),
      diffusion_per_s_(diffusivity_m2_per_s / (resolution_m_ * resolution_m_)) {
  for (std::size_t i = 0; i < spaces_.size(); ++i) {
    if (spaces_[i] != GasSpace::kInside) continue;
    unknown_[i] = static_cast<int>(cells_.size());
    cells_.push_back(spaces_.geometry().CellAtIndex(i));
  }
  const auto add = [this](Cell low, Cell high, double speed_mps) {
    AddFace(speed_mps >= 0.0 ? Face{low, high, speed_mps} : Face{high, low, -speed_mps});
  };
  for (const Cell cell : cells_) {
    constexpr double kRounding_mps = 1e-9;  // of winds without divergence
    const double upwards_mps = -wind.NetOutflow_mps(cell);
    if (upwards_mps < kRounding_mps) continue;
    AddTerm(cell, cell, upwards_mps / resolution_m_);
    open_ = true;
  }
  // Each face once: as the western or southern one of a cell, or on the far edge of the raster.
  for (int y = 0; y <= spaces_.height(); ++y) {
    for (int x = 0; x <= spaces_.width(); ++x) {
      if (y < spaces_.height()) add({x - 1, y}, {x, y}, wind.u(x, y));
      if (x < spaces_.width()) add({x, y - 1}, {x, y}, wind.v(x, y));
    }
  }
}

void Transport::AddTerm(Cell of, Cell by, double rate_per_s) {
  if (SpaceAt(of) != GasSpace::kInside || SpaceAt(by) != GasSpace::kInside) return;
  terms_.emplace_back(unknown_[of], unknown_[by], rate_per_s);
}

void Transport::AddFace(const Face& face) {
  const auto [behind, ahead, speed_mps] = face;
  if (SpaceAt(behind) == GasSpace::kSolid || SpaceAt(ahead) == GasSpace::kSolid) return;
  // Leaves `behind` and enters `ahead`, whichever of them are inside.
  const auto flow = [&](Cell by, double rate_per_s) {
    AddTerm(behind, by, rate_per_s);
    AddTerm(ahead, by, -rate_per_s);
  };
  const double carried_per_s = speed_mps / resolution_m_;
  flow(behind, carried_per_s);
  if (SpaceAt(behind) == GasSpace::kInside && SpaceAt(ahead) == GasSpace::kInside) {
    // Fromm: the slope in `behind` is that between its neighbours; at a wall, which mirrors it, or
    // the edge of the gas, that towards `ahead` alone, halved.
    const Cell before{2 * behind.x - ahead.x, 2 * behind.y - ahead.y};
    const bool mirrored = SpaceAt(before) == GasSpace::kSolid;
    constexpr double kQuarter = 0.25;
    flow(ahead, kQuarter * carried_per_s);
    flow(mirrored ? behind : before, -kQuarter * carried_per_s);
    flow(behind, diffusion_per_s_);
    flow(ahead, -diffusion_per_s_);
    return;
  }
  // Gas is gone when it reaches the face: half a cell from the centre.
  open_ |= SpaceAt(behind) == GasSpace::kInside || SpaceAt(ahead) == GasSpace::kInside;
  AddTerm(behind, behind, 2.0 * diffusion_per_s_);
  AddTerm(ahead, ahead, 2.0 * diffusion_per_s_);
}

Matrix Transport::MatrixWithLoss(double rate_per_s) const {
  const auto n = static_cast<Eigen::Index>(cells_.size());
  Matrix matrix(n, n);
  matrix.setFromTriplets(terms_.begin(), terms_.end());
  for (Eigen::Index i = 0; i < n; ++i) matrix.coeffRef(i, i) += rate_per_s;
  matrix.makeCompressed();
  return matrix;
}

// What one source releases into each cell, ppm m/s: a fresh filament's cloud, scaled to the rate.
Eigen::VectorXd Release(const GasSource& source, const GasParameters& gas,
                        const LayoutRaster& raster, const std::vector<Cell>& cells) {
  SliceRenderer renderer(raster.occupancy, {source}, gas);
  const Grid<float> cloud = renderer.Render({{{source.x_m, source.y_m}, 0, 0}})[0];
  Eigen::VectorXd release(static_cast<Eigen::Index>(cells.size()));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    release[static_cast<Eigen::Index>(i)] = cloud[cells[i]];
  }
  const double cell_m2 = std::pow(raster.occupancy.geometry().resolution_m, 2.0);
  const double released_ppm_m3_per_s = FilamentContent_ppm_m3(source, gas) * gas.filaments_per_s;
  return release * (released_ppm_m3_per_s / (release.sum() * cell_m2));
}

}  // namespace

absl::StatusOr<std::vector<Grid<float>>> SteadyConcentration(const LayoutRaster& raster,
                                                             const MacField& wind,
                                                             const std::vector<GasSource>& sources,
                                                             const GasParameters& gas) {
  const Transport transport(raster, wind, gas.diffusivity_m2_per_s + gas.growth_m2_per_s / 2.0);
  if (!transport.open()) {
    return absl::FailedPreconditionError("gas cannot get out: there is no steady concentration");
  }
  const std::vector<Cell>& cells = transport.cells();
  const auto n = static_cast<Eigen::Index>(cells.size());
  Eigen::MatrixXd release(n, static_cast<Eigen::Index>(sources.size()));
  for (std::size_t s = 0; s < sources.size(); ++s) {
    release.col(static_cast<Eigen::Index>(s)) = Release(sources[s], gas, raster, cells);
  }
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, release.cols());
  Eigen::SparseLU<Matrix> lu;
  for (const DecayTerm& term : InverseDepthTerms(gas)) {
    const Matrix matrix = transport.MatrixWithLoss(term.rate_per_s);
    lu.compute(matrix);
    if (lu.info() != Eigen::Success) return absl::InternalError(lu.lastErrorMessage());
    sum += term.weight_per_m * lu.solve(release);
  }
  std::vector<Grid<float>> layers(sources.size(), Grid<float>(raster.occupancy.geometry()));
  for (std::size_t s = 0; s < sources.size(); ++s) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const double ppm = sum(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(s));
      layers[s][cells[i]] = static_cast<float>(std::max(0.0, ppm));
    }
  }
  return layers;
}

}  // namespace plumescout::lab
