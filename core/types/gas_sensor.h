// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "core/types/ids.h"
#include "core/types/pose2.h"

namespace plumescout {

// One of a robot's gas sensors.
struct GasSensor {
  std::string id;            // among the robot's; the alphabet of RobotId
  Point2 robot_from_sensor;  // where it sits: ahead and to the left, in the robot's own frame
  double stddev_ppm = 0.0;   // of readings that bring none; 0: the mission's model
  // Of the unknown offset that all its readings have, from its data sheet; 0: it is calibrated.
  double offset_stddev_ppm = 0.0;
  std::string species = {};  // what it reads, by name; empty: the mission's first gas
  // Of the first-order lag that its readings have, to be undone along its way (WayReadings); 0:
  // they are of the air where they are taken.
  double response_time_s = 0.0;

  friend bool operator==(const GasSensor&, const GasSensor&) = default;
};

// What a mission knows of the offset of one sensor.
struct SensorOffset {
  RobotId robot;
  std::string sensor;
  double offset_ppm = 0.0;
  double stddev_ppm = 0.0;
  std::int64_t crossings = 0;  // readings of it that were taken where and when another sensor read
  bool estimated = false;      // those are enough; if not, its readings are taken as they are
  bool drifting = false;       // it reads other than it did, beside the same other sensor
  std::string species = {};    // what it reads; empty: the mission names no gas

  friend bool operator==(const SensorOffset&, const SensorOffset&) = default;
};

}  // namespace plumescout
