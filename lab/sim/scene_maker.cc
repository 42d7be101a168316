// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/scene_maker.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/types/checker.h"
#include "core/types/status_macros.h"
#include "lab/sim/cell_wind.h"
#include "lab/sim/concentration_slice.h"
#include "lab/sim/frame_recorder.h"
#include "lab/sim/layout_raster.h"
#include "lab/sim/mac_field.h"
#include "lab/sim/plume.h"

namespace plumescout::lab {
namespace {

constexpr double kWindShare = 0.3;  // of the whole work, for the progress bar
constexpr double kMaxWarmUp_s = 3600.0;
constexpr int kMaxFrames = 10'000;
constexpr double kMaxFramePeriod_s = 60.0;

std::int64_t StepsIn(double duration_s) { return std::llround(duration_s / Plume::kStep_s); }

void BlowGas(const Layout& layout, const LayoutRaster& raster, const MacField& wind,
             const SceneMakerOptions& options, const FractionFn& progress, Scene& scene) {
  Plume plume(raster, wind, layout.sources, layout.gas, options.seed, -options.warm_up_s);
  SliceRenderer renderer(raster.occupancy, layout.sources, layout.gas);
  FrameRecorder recorder(raster.occupancy.geometry(), layout.sources.size(), options.frames,
                         options.frame_period_s);
  const std::int64_t warm_up = StepsIn(options.warm_up_s);
  const std::int64_t period = StepsIn(options.frame_period_s);
  const std::int64_t all = warm_up + (options.frames - 1) * period;
  for (std::int64_t step = 0; step <= all; ++step) {
    if (step >= warm_up && (step - warm_up) % period == 0) {
      recorder.Add(renderer.Render(plume.filaments()));
      progress(static_cast<double>(step) / static_cast<double>(std::max<std::int64_t>(1, all)));
    }
    if (step < all) plume.Step();
  }
  recorder.MoveTo(scene);
}

Scene SceneOf(const Layout& layout, const LayoutRaster& raster) {
  Scene scene;
  scene.name = layout.name;
  scene.sensor_height_m = layout.sensor_height_m;
  scene.occupancy = raster.occupancy;
  scene.sources = layout.sources;
  scene.openings = layout.openings;
  scene.start_pose = layout.start_pose;
  scene.critical_threshold_ppm = layout.critical_threshold_ppm;
  return scene;
}

}  // namespace

absl::Status Validate(const SceneMakerOptions& options) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options.wind));
  const double period_s = options.frame_period_s;
  PLUMESCOUT_RETURN_IF_ERROR(Checker()
                                 .InRange("warm_up_s", options.warm_up_s, 0.0, kMaxWarmUp_s)
                                 .InRange("frames", options.frames, 1, kMaxFrames)
                                 .InRangeAbove("frame_period_s", period_s, 0.0, kMaxFramePeriod_s)
                                 .status());
  const double whole_s = static_cast<double>(StepsIn(period_s)) * Plume::kStep_s;
  constexpr double kRounding_s = 1e-9;
  return Checker()
      .Require(std::abs(whole_s - period_s) <= kRounding_s, "frame_period_s", period_s,
               "must be a whole number of steps of 0.05 s")
      .status();
}

absl::StatusOr<Scene> MakeScene(const Layout& layout, const SceneMakerOptions& options,
                                const ProgressFn& progress) {
  PLUMESCOUT_RETURN_IF_ERROR(Validate(options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const LayoutRaster raster, Rasterize(layout));
  const auto report = [&](absl::string_view stage, double fraction) {
    if (progress) progress(stage, fraction);
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(const MacField wind,
                              SolveWind(raster.flow, options.wind, [&](double fraction) {
                                report("wind", kWindShare * fraction);
                              }));
  Scene scene = SceneOf(layout, raster);
  scene.wind = CellWind(wind, raster.occupancy);
  const auto gas_progress = [&](double fraction) {
    report("gas", kWindShare + (1.0 - kWindShare) * fraction);
  };
  BlowGas(layout, raster, wind, options, gas_progress, scene);
  return scene;
}

}  // namespace plumescout::lab
