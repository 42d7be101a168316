// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "lab/formats/scene.h"

namespace plumescout::lab {

// A scene is a folder:
//
//   scene.json               name, geometry, sources, start pose, openings, layout of the series
//   map.pgm, map.yaml        map_server pair, free or occupied, never unknown
//   conc_mean.npy            float32 [height][width], ppm
//   conc_std.npy             float32 [height][width], ppm
//   conc_mean_by_source.npy  float32 [sources][height][width], ppm
//   conc_ts.u16.zst          one zstd frame of little-endian uint16 [frames][height][width]
//   wind_uv.npy              float32 [height][width][2], m/s; only if scene.json names it
//
// Arrays start with the southern row, the image with the northern one.

// Errors, naming the file: kNotFound, kDataLoss if a file is damaged, kInvalidArgument if files
// disagree, a value is out of range or something is larger than its limit.
absl::StatusOr<Scene> ReadScene(const std::string& folder);

// Makes the folder if need be. kInvalidArgument if the scene is invalid; else as WriteFile.
absl::Status WriteScene(const Scene& scene, const std::string& folder);

}  // namespace plumescout::lab
