// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/pose2.h"
#include "lab/formats/release_schedule.h"

namespace plumescout::lab {

// A leak. The rate while it releases is (ppm at the centre of a new filament) x (filaments per
// second).
struct GasSource {
  int id = 0;
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
  double rate_ppm_per_s = 0.0;
  ReleaseSchedule release = {};  // default: always

  friend bool operator==(const GasSource&, const GasSource&) = default;
};

// Concentration over time; frame t is the state t * dt_s after the start of the run.
struct ConcentrationSeries {
  int frames = 0;
  double dt_s = 0.5;
  double scale_ppm_per_count = 0.05;
  std::vector<std::uint16_t> counts;  // frames x height x width, index = t * cells + cell index

  friend bool operator==(const ConcentrationSeries&, const ConcentrationSeries&) = default;
};

// Horizontal wind at the sensor's height; zero in obstacles.
struct WindField {
  Grid<float> u_mps;  // eastward
  Grid<float> v_mps;  // northward

  friend bool operator==(const WindField&, const WindField&) = default;
};

enum class Side { kWest, kEast, kSouth, kNorth };

// "west", "east", "south", "north".
absl::string_view NameOf(Side side);
std::optional<Side> SideNamed(absl::string_view name);

// Window or vent in the outer wall of a building. Air passes; robots, beams and maps see a wall.
struct Opening {
  Side side = Side::kWest;
  double from_m = 0.0;               // along x on the south and north side, along y on the others
  double to_m = 0.0;                 // > from_m
  std::optional<double> inflow_mps;  // > 0, at right angles into the building; none: outlet

  friend bool operator==(const Opening&, const Opening&) = default;
};

// A place with a gas leak and everything that is true of it. All rasters have the geometry of
// `occupancy`, which is never unknown; occupied cells have concentration 0.
struct Scene {
  std::string name;
  double sensor_height_m = 0.5;
  Grid<CellState> occupancy;
  Grid<float> conc_mean_ppm;  // over all frames: the truth that errors are measured against
  Grid<float> conc_std_ppm;   // over the frames
  std::vector<Grid<float>> conc_mean_by_source_ppm;  // in the order of `sources`
  ConcentrationSeries series;
  std::optional<WindField> wind;
  std::vector<Opening> openings;  // in frame map; none if not known
  std::vector<GasSource> sources;
  Pose2 start_pose;                     // of the robot, on a free cell
  double critical_threshold_ppm = 2.5;  // [XIT] Sec. VI-B: free cells above it are critical

  const GridGeometry& geometry() const { return occupancy.geometry(); }
};

// kInvalidArgument, naming the field and the value, unless all rasters have the geometry of the
// occupancy, all numbers are finite, concentrations are not negative, the start stands on a free
// cell and the openings lie apart in the outer walls.
absl::Status ValidateScene(const Scene& scene);

// Concentration at the cell nearest to `point` in the frame nearest to `time_s`, both clamped to
// the scene, ppm. REQUIRES: the scene is valid.
double SampleConcentration_ppm(const Scene& scene, Point2 point, double time_s);

}  // namespace plumescout::lab
