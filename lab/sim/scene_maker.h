// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "lab/formats/scene.h"
#include "lab/sim/layout.h"
#include "lab/sim/wind.h"

namespace plumescout::lab {

struct SceneMakerOptions {
  WindOptions wind;
  double warm_up_s = 180.0;     // before frame 0, [0, 3600]: sources that always release do
  int frames = 600;             // [1, 10000]; 600 at 2 Hz are the 5 minutes of [XIT] section VI-B
  double frame_period_s = 0.5;  // a whole number of Plume::kStep_s, (0, 60]
  std::uint64_t seed = 1;
};

// kInvalidArgument naming field, value and range.
absl::Status Validate(const SceneMakerOptions& options);

// Told what is being done ("wind", "gas") and the finished share of the whole.
using ProgressFn = std::function<void(absl::string_view stage, double fraction)>;

// A scene from a layout: its raster, the wind through it, the gas in that wind, as frames and as
// means over them; schedules of sources count from frame 0. The same arguments give the same bytes.
// Errors: kInvalidArgument from Validate and Rasterize. Cost: 160 x 200 cells with the options'
// defaults take some 20 s of one core.
absl::StatusOr<Scene> MakeScene(const Layout& layout, const SceneMakerOptions& options,
                                const ProgressFn& progress = nullptr);

}  // namespace plumescout::lab
