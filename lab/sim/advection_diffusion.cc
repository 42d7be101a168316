// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/advection_diffusion.h"

#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"
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
  // Structured bindings could not be captured below: clang knows no such captures yet.
  const Cell behind = face.behind;
  const Cell ahead = face.ahead;
  if (SpaceAt(behind) == GasSpace::kSolid || SpaceAt(ahead) == GasSpace::kSolid) return;
  // Leaves `behind` and enters `ahead`, whichever of them are inside.
  const auto flow = [&](Cell by, double rate_per_s) {
    AddTerm(behind, by, rate_per_s);
    AddTerm(ahead, by, -rate_per_s);
  };
  const double carried_per_s = face.speed_mps / resolution_m_;
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

// Solves the law for every term of the depth, and adds up.
class Solver {
 public:
  Solver(const LayoutRaster& raster, const MacField& wind, const std::vector<GasSource>& sources,
         const GasParameters& gas);

  bool open() const { return transport_.open(); }
  absl::Status AddSteady(const DecayTerm& term);
  absl::Status AddMean(const DecayTerm& term, const MeanWindow& window);
  std::vector<Grid<float>> Layers() const;

 private:
  absl::Status Factorize(double rate_per_s);

  const GridGeometry geometry_;
  Transport transport_;
  Eigen::MatrixXd release_;  // by cell and source
  Eigen::MatrixXd sum_ppm_;  // likewise
  Eigen::SparseLU<Matrix> lu_;
};

Solver::Solver(const LayoutRaster& raster, const MacField& wind,
               const std::vector<GasSource>& sources, const GasParameters& gas)
    : geometry_(raster.occupancy.geometry()),
      transport_(raster, wind, gas.diffusivity_m2_per_s + gas.growth_m2_per_s / 2.0),
      release_(static_cast<Eigen::Index>(transport_.cells().size()),
               static_cast<Eigen::Index>(sources.size())),
      sum_ppm_(Eigen::MatrixXd::Zero(release_.rows(), release_.cols())) {
  for (std::size_t s = 0; s < sources.size(); ++s) {
    release_.col(static_cast<Eigen::Index>(s)) =
        Release(sources[s], gas, raster, transport_.cells());
  }
}

absl::Status Solver::Factorize(double rate_per_s) {
  lu_.compute(transport_.MatrixWithLoss(rate_per_s));
  if (lu_.info() == Eigen::Success) return absl::OkStatus();
  return absl::InternalError(lu_.lastErrorMessage());
}

absl::Status Solver::AddSteady(const DecayTerm& term) {
  PLUMESCOUT_RETURN_IF_ERROR(Factorize(term.rate_per_s));
  sum_ppm_ += term.weight_per_m * lu_.solve(release_);
  return absl::OkStatus();
}

absl::Status Solver::AddMean(const DecayTerm& term, const MeanWindow& window) {
  PLUMESCOUT_RETURN_IF_ERROR(Factorize(term.rate_per_s + 1.0 / kMeanStep_s));
  const auto warm_up = std::llround(window.warm_up_s / kMeanStep_s);
  const auto steps = std::max<long long>(1, std::llround(window.mean_s / kMeanStep_s));
  Eigen::MatrixXd now = Eigen::MatrixXd::Zero(release_.rows(), release_.cols());
  for (long long step = 0; step < warm_up + steps; ++step) {
    now = lu_.solve(release_ + now / kMeanStep_s).eval();
    if (step >= warm_up) sum_ppm_ += term.weight_per_m / static_cast<double>(steps) * now;
  }
  return absl::OkStatus();
}

std::vector<Grid<float>> Solver::Layers() const {
  std::vector<Grid<float>> layers(static_cast<std::size_t>(release_.cols()),
                                  Grid<float>(geometry_));
  for (std::size_t s = 0; s < layers.size(); ++s) {
    for (std::size_t i = 0; i < transport_.cells().size(); ++i) {
      const double ppm = sum_ppm_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(s));
      layers[s][transport_.cells()[i]] = static_cast<float>(std::max(0.0, ppm));
    }
  }
  return layers;
}

}  // namespace

absl::StatusOr<std::vector<Grid<float>>> SteadyConcentration(const LayoutRaster& raster,
                                                             const MacField& wind,
                                                             const std::vector<GasSource>& sources,
                                                             const GasParameters& gas) {
  Solver solver(raster, wind, sources, gas);
  if (!solver.open()) {
    return absl::FailedPreconditionError("gas cannot get out: there is no steady concentration");
  }
  for (const DecayTerm& term : InverseDepthTerms(gas)) {
    PLUMESCOUT_RETURN_IF_ERROR(solver.AddSteady(term));
  }
  return solver.Layers();
}

absl::StatusOr<std::vector<Grid<float>>> MeanConcentration(const LayoutRaster& raster,
                                                           const MacField& wind,
                                                           const std::vector<GasSource>& sources,
                                                           const GasParameters& gas,
                                                           const MeanWindow& window) {
  constexpr double kMaxTime_s = 1e5;
  PLUMESCOUT_RETURN_IF_ERROR(Checker()
                                 .InRange("warm_up_s", window.warm_up_s, 0.0, kMaxTime_s)
                                 .InRangeAbove("mean_s", window.mean_s, 0.0, kMaxTime_s)
                                 .status());
  Solver solver(raster, wind, sources, gas);
  for (const DecayTerm& term : InverseDepthTerms(gas)) {
    // After 7 times their own, exp(-7) = 0.1 % are missing from being steady.
    constexpr double kSteady = 7.0;
    const bool steady = term.rate_per_s * window.warm_up_s > kSteady;
    PLUMESCOUT_RETURN_IF_ERROR(steady ? solver.AddSteady(term) : solver.AddMean(term, window));
  }
  return solver.Layers();
}

}  // namespace plumescout::lab
