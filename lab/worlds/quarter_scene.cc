// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/quarter_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "lab/sim/advection_diffusion.h"
#include "lab/sim/cell_wind.h"
#include "lab/sim/frame_recorder.h"
#include "lab/sim/layout_raster.h"
#include "lab/sim/wind.h"

namespace plumescout::lab {
namespace {

constexpr double kWind_mps = 3.0;
constexpr double kSmoothShare = 0.5;      // of the ideal fluid in it
constexpr double kDuration_s = 10'000.0;  // [IPP] Alg. 1, line 9
constexpr double kFramePeriod_s = 20.0;
constexpr double kTruthRms_ppm = 20.0;

// The cross-wind: mean, standard deviation, how long it remembers, and the steps in which the plume
// is computed, up to two and a half deviations either way.
constexpr double kCrossWind_mps = 0.8;
constexpr double kGust_mps = 0.5;
constexpr double kGustMemory_s = 300.0;
constexpr double kGustStep_mps = 0.125;
constexpr int kGustSteps = 10;  // each way
constexpr int kPlumes = 2 * kGustSteps + 1;

WindOptions QuarterWind() {
  WindOptions options;
  options.viscosity_m2_per_s = 1.0;  // eddies of some 10 m at some 0.1 m/s
  options.flow_s = 1200.0;           // four times as long as air takes through the raster
  return options;
}

GasParameters QuarterGas() {
  GasParameters gas;
  gas.initial_sigma_m = 5.0;       // less than a cell
  gas.diffusivity_m2_per_s = 8.0;  // eddies as large as the houses, 20 m, at 0.4 m/s
  gas.growth_m2_per_s = 1.0;
  gas.mixing_depth_m = 20.0;  // the height of the houses
  return gas;
}

// Where air comes in through one side and leaves through the opposite one, over their whole length.
// The other sides slide along with it.
FlowDomain Channel(const Grid<CellState>& occupancy, Side inlet, double speed_mps) {
  const GridGeometry& geometry = occupancy.geometry();
  FlowDomain domain;
  domain.fluid = Grid<std::uint8_t>(geometry);
  for (std::size_t i = 0; i < occupancy.size(); ++i) {
    domain.fluid[i] = occupancy[i] == CellState::kFree ? 1 : 0;
  }
  const auto open = [&](Cell low, Cell high, Side low_side, Side high_side) {
    domain.openings.push_back({low, low_side, speed_mps});
    domain.openings.push_back({high, high_side, std::nullopt});
  };
  if (inlet == Side::kWest) {
    for (int y = 0; y < geometry.height; ++y) {
      open({0, y}, {geometry.width - 1, y}, Side::kWest, Side::kEast);
    }
  } else {
    for (int x = 0; x < geometry.width; ++x) {
      open({x, 0}, {x, geometry.height - 1}, Side::kSouth, Side::kNorth);
    }
  }
  domain.edge_speeds_mps.fill(speed_mps);
  return domain;
}

// The winds that blow: from the west, and across it at 1 m/s.
struct Winds {
  MacField west;
  MacField across;

  MacField With(double gust_mps) const {
    MacField wind = west;
    wind.AddScaled(across, kCrossWind_mps + gust_mps);
    return wind;
  }
};

absl::StatusOr<Winds> SolveWinds(const Grid<CellState>& occupancy) {
  Winds winds;
  PLUMESCOUT_ASSIGN_OR_RETURN(winds.west,
                              SolveWind(Channel(occupancy, Side::kWest, kWind_mps), QuarterWind()));
  WindOptions potential;
  potential.model = WindModel::kPotential;
  PLUMESCOUT_ASSIGN_OR_RETURN(winds.across,
                              SolveWind(Channel(occupancy, Side::kSouth, 1.0), potential));
  PLUMESCOUT_ASSIGN_OR_RETURN(const MacField smooth,
                              SolveWind(Channel(occupancy, Side::kWest, kWind_mps), potential));
  winds.west.AddScaled(winds.west, -kSmoothShare);
  winds.west.AddScaled(smooth, kSmoothShare);
  return winds;
}

// A share of one of the plumes and the rest of the next.
struct PlumeMix {
  int first = 0;
  double share_of_next = 0.0;
};

// Frame by frame.
std::vector<PlumeMix> DrawGusts(Rng& rng) {
  const double kept = std::exp(-kFramePeriod_s / kGustMemory_s);
  const double renewed = std::sqrt(1.0 - kept * kept);
  double gust = rng.Gaussian();  // in standard deviations
  std::vector<PlumeMix> mixes;
  for (double time_s = 0.0; time_s <= kDuration_s; time_s += kFramePeriod_s) {
    const double steps = std::clamp(gust * kGust_mps / kGustStep_mps + kGustSteps, 0.0,
                                    static_cast<double>(kPlumes - 1));
    const int first = std::min(static_cast<int>(steps), kPlumes - 2);
    mixes.push_back({first, steps - first});
    gust = kept * gust + renewed * rng.Gaussian();
  }
  return mixes;
}

// A street cell in the windward part of the quarter, so that the plume goes through the rest.
GasSource DrawSource(const QuarterPlan& plan, Rng& rng) {
  const GridGeometry& geometry = plan.occupancy.geometry();
  const BuiltUpArea& area = plan.built_up;
  // In half sizes of the built-up area, from its centre.
  constexpr double kWest = -0.7, kEast = -0.3, kSouth = -0.5, kNorth = 0.1;
  std::vector<Cell> candidates;
  for (std::size_t i = 0; i < plan.occupancy.size(); ++i) {
    const Cell cell = geometry.CellAtIndex(i);
    const Point2 at = geometry.Center(cell);
    const double x = (at.x_m - area.center.x_m) / area.half_width_m;
    const double y = (at.y_m - area.center.y_m) / area.half_height_m;
    const bool fits = x > kWest && x < kEast && y > kSouth && y < kNorth;
    if (fits && plan.occupancy[i] == CellState::kFree) candidates.push_back(cell);
  }
  const Point2 at = geometry.Center(candidates[rng.Below(candidates.size())]);
  GasSource source;
  source.x_m = at.x_m;
  source.y_m = at.y_m;
  source.rate_ppm_per_s = 1.0;  // until the scale is known
  return source;
}

// The standing plume for each step of the cross-wind.
absl::StatusOr<std::vector<Grid<float>>> SolvePlumes(const QuarterPlan& plan, const Winds& winds,
                                                     const GasSource& source) {
  LayoutRaster raster;
  raster.occupancy = plan.occupancy;
  raster.flow = Channel(plan.occupancy, Side::kWest, kWind_mps);
  std::vector<Grid<float>> plumes;
  for (int step = -kGustSteps; step <= kGustSteps; ++step) {
    PLUMESCOUT_ASSIGN_OR_RETURN(
        std::vector<Grid<float>> layers,
        SteadyConcentration(raster, winds.With(step * kGustStep_mps), {source}, QuarterGas()));
    plumes.push_back(std::move(layers.front()));
  }
  return plumes;
}

Grid<float> Mixed(const std::vector<Grid<float>>& plumes, const PlumeMix& mix, double scale) {
  const auto first = static_cast<std::size_t>(mix.first);
  Grid<float> mixed = plumes[first];
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    const double ppm = std::lerp(static_cast<double>(plumes[first][i]),
                                 static_cast<double>(plumes[first + 1][i]), mix.share_of_next);
    mixed[i] = static_cast<float>(scale * ppm);
  }
  return mixed;
}

// What plumes are multiplied by to give the mean over time the root mean square that is asked for.
double ScaleOf(const std::vector<Grid<float>>& plumes, const std::vector<PlumeMix>& mixes,
               const Grid<CellState>& occupancy) {
  std::array<double, kPlumes> weights{};
  for (const PlumeMix& mix : mixes) {
    weights[static_cast<std::size_t>(mix.first)] += 1.0 - mix.share_of_next;
    weights[static_cast<std::size_t>(mix.first) + 1] += mix.share_of_next;
  }
  double squares = 0.0;
  int free_cells = 0;
  for (std::size_t i = 0; i < occupancy.size(); ++i) {
    if (occupancy[i] != CellState::kFree) continue;
    double sum = 0.0;
    for (std::size_t k = 0; k < plumes.size(); ++k) {
      sum += weights[k] * static_cast<double>(plumes[k][i]);
    }
    squares += sum * sum;
    ++free_cells;
  }
  const double rms = std::sqrt(squares / free_cells) / static_cast<double>(mixes.size());
  return kTruthRms_ppm / rms;
}

// Three places in the plume and two out of it among the houses, then two in and three out of it in
// the open, apart from each other where there is room.
std::vector<Point2> DrawStarts(const Scene& scene, const BuiltUpArea& built_up, Rng& rng) {
  struct Kind {
    bool among_houses, in_plume;
    int count;
  };
  constexpr std::array<Kind, 4> kKinds = {
      {{true, true, 3}, {true, false, 2}, {false, true, 2}, {false, false, 3}}};
  constexpr double kApart_m = 60.0;
  constexpr int kTries = 50;
  const GridGeometry& geometry = scene.geometry();
  std::vector<Point2> starts;
  for (const Kind& kind : kKinds) {
    std::vector<Point2> places;
    for (std::size_t i = 0; i < scene.occupancy.size(); ++i) {
      const Point2 at = geometry.Center(geometry.CellAtIndex(i));
      const bool in_plume = scene.conc_mean_ppm[i] > scene.critical_threshold_ppm;
      const bool fits = in_plume == kind.in_plume && built_up.Holds(at) == kind.among_houses;
      if (fits && scene.occupancy[i] == CellState::kFree) places.push_back(at);
    }
    for (int k = 0; k < kind.count && !places.empty(); ++k) {
      Point2 place;
      for (int tries = 0; tries < kTries; ++tries) {
        place = places[rng.Below(places.size())];
        const bool alone = std::none_of(starts.begin(), starts.end(), [&](Point2 other) {
          return Distance_m(place, other) < kApart_m;
        });
        if (alone) break;
      }
      starts.push_back(place);
    }
  }
  return starts;
}

}  // namespace

absl::StatusOr<QuarterWorld> MakeQuarterWorld(std::uint64_t seed) {
  Rng seeds(seed);
  const QuarterPlan plan = MakeQuarterPlan(seeds.Next());
  Rng rng(seeds.Next());
  GasSource source = DrawSource(plan, rng);
  const std::vector<PlumeMix> mixes = DrawGusts(rng);
  PLUMESCOUT_ASSIGN_OR_RETURN(const Winds winds, SolveWinds(plan.occupancy));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Grid<float>> plumes,
                              SolvePlumes(plan, winds, source));
  const double scale = ScaleOf(plumes, mixes, plan.occupancy);
  source.rate_ppm_per_s *= scale;

  QuarterWorld world;
  world.built_up = plan.built_up;
  Scene& scene = world.scene;
  scene.name = "quarter";
  scene.occupancy = plan.occupancy;
  scene.sources = {source};
  scene.wind = CellWind(winds.With(0.0), plan.occupancy);
  FrameRecorder recorder(scene.geometry(), 1, static_cast<int>(mixes.size()), kFramePeriod_s);
  for (const PlumeMix& mix : mixes) recorder.Add({Mixed(plumes, mix, scale)});
  recorder.MoveTo(scene);
  world.starts = DrawStarts(scene, world.built_up, rng);
  scene.start_pose = {world.starts.front().x_m, world.starts.front().y_m, 0.0};
  return world;
}

}  // namespace plumescout::lab
