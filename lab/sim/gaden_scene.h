// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/types/pose2.h"
#include "lab/formats/scene.h"
#include "lab/sim/scene_maker.h"

namespace plumescout::lab {

// Results of GADEN to be made a scene.
struct GadenImport {
  // Folders of iteration_N, one per simulation: GADEN simulates one source at a time. Their gas
  // adds up.
  std::vector<std::string> results;
  // Folder of OccupancyGrid3D.csv; empty: the first of results[0] and the three folders above it
  // that has the file, as in GADEN's own projects.
  std::string environment;
  std::string name = "gaden";
  double height_m = 0.5;        // of the sensor, in the environment's coordinates
  double frame_period_s = 0.5;  // (0, 60]; the files do not tell: GADEN's saveDeltaTime
  int skip_frames = 0;          // at the beginning, while the plume spreads
  Pose2 start_pose;             // of the robot
  // By result, (ppm at a new filament's centre) x (filaments per second); empty: not known, 0.
  std::vector<double> rates_ppm_per_s;
};

// The horizontal slice at the sensor's height through all frames. The map is the slice too: cells
// that are not free there (obstacles, outlets) are occupied, and so is what the start is not
// connected to. The wind is the mean over the frames, from the files wind/wind_iteration_N beside
// the frames (GADEN 2) or the environment (GADEN 3); without such a folder the scene has none. The
// critical threshold is [XIT]'s 2.5 ppm.
//
// Errors, naming the file or field and the value: those of the readers in formats/gaden_*.h;
// kNotFound without an environment or frames; kInvalidArgument if a frame is missing in the middle,
// simulations differ in their number of frames or belong to other environments, the start is not
// free, or a field is out of range. All files are looked for before any is sliced.
absl::StatusOr<Scene> ImportGaden(const GadenImport& import, const ProgressFn& progress = nullptr);

}  // namespace plumescout::lab
