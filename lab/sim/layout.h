// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "core/types/pose2.h"
#include "core/types/rectangle.h"
#include "lab/formats/scene.h"

namespace plumescout::lab {

// Gap in a wall.
struct Door {
  double at_m = 0.0;     // of its middle, along the wall from Wall::from; wholly in the wall
  double width_m = 1.0;  // > 0

  friend bool operator==(const Door&, const Door&) = default;
};

// Straight wall, at any angle, with square ends half a thickness beyond `from` and `to`.
struct Wall {
  Point2 from;
  Point2 to;
  double thickness_m = 0.2;  // > 0
  std::vector<Door> doors;

  friend bool operator==(const Wall&, const Wall&) = default;
};

// Ventilator in a room: it moves the air that passes it, at one speed over its whole width. Robots,
// beams and the map do not see it.
struct Fan {
  Point2 position;             // of its middle
  double direction_rad = 0.0;  // in which it blows, from the x axis, [-2 pi, 2 pi]
  double width_m = 0.0;        // at right angles to that; at least about one cell
  double speed_mps = 0.0;      // (0, 30]

  friend bool operator==(const Fan&, const Fan&) = default;
};

// How released gas spreads. Sources: [XIT] Table I for the growth; the mixing depth was fitted to a
// three-dimensional simulation of a hall 2.4 m high; the rest as GADEN scenes commonly have it.
struct GasParameters {
  double filaments_per_s = 100.0;      // of each source, [1, 1000]
  double initial_sigma_m = 0.1;        // sigma_0 of a new filament, (0, 5]
  double growth_m2_per_s = 0.0015;     // gamma: 15 cm^2/s, [0, 1]
  double diffusivity_m2_per_s = 0.02;  // K of the filaments' random walk, [0, 1]
  double mixing_depth_m = 2.05;        // height over which old gas is spread, (0, 100]

  friend bool operator==(const GasParameters&, const GasParameters&) = default;
};

// A building as a researcher describes it: metres, origin in the lower-left corner.
struct Layout {
  std::string name;
  double size_x_m = 0.0;      // (0, 200]
  double size_y_m = 0.0;      // (0, 200]
  double resolution_m = 0.1;  // [0.02, 1]; at most 1,000,000 cells in all
  double border_m = 0.2;      // thickness of the outer wall, >= one cell
  std::vector<Wall> walls;
  // Solid: containers, pillars, machines. They may touch but not overlap.
  std::vector<Rectangle> boxes;
  std::vector<Opening> openings;  // inlets blow at (0, 30] m/s
  std::vector<Fan> fans;
  std::vector<GasSource> sources;  // at least one
  Pose2 start_pose;
  double sensor_height_m = 0.4;         // >= 0
  double critical_threshold_ppm = 2.5;  // [XIT] section VI-B, > 0
  GasParameters gas;

  friend bool operator==(const Layout&, const Layout&) = default;
};

// kInvalidArgument naming field, value and range, e.g. "walls[2].thickness_m = 0 must be > 0".
// Whether the parts fit together (sources in the open, ...) is Rasterize's to say.
absl::Status Validate(const Layout& layout);

}  // namespace plumescout::lab
