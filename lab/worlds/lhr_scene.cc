// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/lhr_scene.h"

#include <cstddef>

#include "core/types/rng.h"
#include "lab/sim/frame_recorder.h"

namespace plumescout::lab {
namespace {

constexpr double kSide_m = kLhrNodes - 1.0;  // between the outermost nodes

double NearCoordinate_m(double at_m, Rng& rng) {
  constexpr double kSpread_m = 5.0;
  while (true) {
    const double drawn_m = at_m + kSpread_m * rng.Gaussian();
    if (drawn_m >= kLhrOffset_m && drawn_m <= kLhrOffset_m + kSide_m) return drawn_m;
  }
}

// The plume of one source, with the wind along -y.
Grid<float> Layer(const LhrSource& source, const LhrAir& air, const GridGeometry& geometry) {
  Grid<float> layer_ppm(geometry);
  const double scale = source.rate_g_per_s * air.ppm_per_g_per_m3;
  for (std::size_t i = 0; i < layer_ppm.size(); ++i) {
    const Point2 at = geometry.Center(geometry.CellAtIndex(i));
    layer_ppm[i] =
        static_cast<float>(scale * air.plume.PerRate_s_per_m3(source.position.y_m - at.y_m,
                                                              source.position.x_m - at.x_m));
  }
  return layer_ppm;
}

GasSource ToGasSource(const LhrSource& source, int id, const LhrAir& air) {
  GasSource gas;
  gas.id = id;
  gas.x_m = source.position.x_m;
  gas.y_m = source.position.y_m;
  gas.rate_ppm_per_s = source.rate_g_per_s * air.ppm_per_g_per_m3;
  return gas;
}

}  // namespace

std::vector<LhrSource> LhrTable1Sources() {
  return {{LhrPlace(45.28, 6.35), 12.07},
          {LhrPlace(31.61, 4.87), 12.56},
          {LhrPlace(27.34, 47.87), 9.39},
          {LhrPlace(7.88, 48.52), 12.82},
          {LhrPlace(24.26, 40.0), 12.78}};
}

std::vector<LhrSource> LhrScenarioSources(std::uint64_t seed, int scenario) {
  constexpr double kRateSpread = 0.2;
  std::uint64_t scenario_seed = 0;
  Rng seeds(seed);
  for (int i = 0; i <= scenario; ++i) scenario_seed = seeds.Next();
  Rng rng(scenario_seed);
  std::vector<LhrSource> sources = LhrTable1Sources();
  for (LhrSource& source : sources) {
    source.position.x_m = NearCoordinate_m(source.position.x_m, rng);
    source.position.y_m = NearCoordinate_m(source.position.y_m, rng);
    source.rate_g_per_s *= rng.Uniform(1.0 - kRateSpread, 1.0 + kRateSpread);
  }
  return sources;
}

std::array<Point2, 4> LhrStarts() {
  return {LhrPlace(0.0, 0.0), LhrPlace(kSide_m, 0.0), LhrPlace(0.0, kSide_m),
          LhrPlace(kSide_m, kSide_m)};
}

Scene MakeLhrScene(const std::vector<LhrSource>& sources, const LhrAir& air) {
  constexpr double kFramePeriod_s = 1.0;  // of a single frame, which holds for ever
  const GridGeometry geometry{0.0, 0.0, 1.0, kLhrNodes, kLhrNodes};
  Scene scene;
  scene.name = "lhr";
  scene.occupancy = Grid<CellState>(geometry, CellState::kFree);
  scene.wind = WindField{Grid<float>(geometry),
                         Grid<float>(geometry, static_cast<float>(-air.plume.wind_mps))};
  const Point2 start = LhrStarts().front();
  scene.start_pose = {start.x_m, start.y_m, 0.0};
  std::vector<Grid<float>> layers;
  for (const LhrSource& source : sources) {
    layers.push_back(Layer(source, air, geometry));
    scene.sources.push_back(ToGasSource(source, static_cast<int>(scene.sources.size()), air));
  }
  FrameRecorder recorder(geometry, sources.size(), 1, kFramePeriod_s);
  recorder.Add(layers);
  recorder.MoveTo(scene);
  return scene;
}

}  // namespace plumescout::lab
