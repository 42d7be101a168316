// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "core/types/gas_reading.h"
#include "core/types/pose2.h"
#include "core/types/rng.h"
#include "lab/sim/scene_world.h"

namespace plumescout::lab {

// A robot stands at one place for a while.
struct Dwell {
  Point2 place;
  double begin_s = 0.0;  // since the run began
  double end_s = 0.0;
};

// What it reads there, noise included: one reading for the whole time.
using DwellSensor = std::function<GasReading(const Dwell&, Rng&)>;

// Noise of a mean over a dwell, Gaussian: its parts are independent.
struct DwellNoise {
  double sigma_ppm = 0.1;
  double share = 0.01;  // of the concentration
  // Variance for each ppm, ppm^2 / ppm: [LHR] II-A has it proportional to the reading. If it is
  // above 0, readings bring what it makes of them, and at least `least_told_ppm2`, for a reading of
  // nothing is not certain.
  double variance_per_ppm = 0.0;
  double least_told_ppm2 = 0.1;
};

// The mean of the world's gas over the dwell, with noise, never negative: what [IPP] section IV
// makes of noisy values around the robot, and [LHR] section IV-A of its ground truth. Without
// `variance_per_ppm` the readings bring no variance: the mission's model holds. `world` must
// outlive the sensor.
DwellSensor MakeDwellSensor(const SceneWorld& world, const DwellNoise& noise);

}  // namespace plumescout::lab
