// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "core/types/options.h"
#include "lab/bench/bench_summary.h"

namespace plumescout::lab {

// Robots in a fenced field of side x side metres, each in a part of its own, in serpentines at
// 1.25 m/s. Each scans all round, 95 m far, and reads twice a second, by a sensor that lags half a
// second and says so.
struct OutdoorDrive {
  double side_m = 200.0;
  int robots = 1;
  int scans = 60;        // of each robot
  double scan_hz = 1.0;  // robots send ten; at one a second each scan shows more that is new
};

// CPU time of each scan with all that the gas field needs until the next one, memory as the process
// has it and as the mission reckons it, and how much of the ground the field is made of.
absl::Status MeasureDrive(const OutdoorDrive& drive, const MissionOptions& options,
                          const std::string& name, BenchSummary& summary);

}  // namespace plumescout::lab
