// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "client/robot_driver.h"
#include "core/types/gas_reading.h"
#include "core/types/observation.h"
#include "core/types/pose2.h"
#include "core/types/scan.h"

namespace plumescout::client {

// What a robot program says in one line.
struct RobotLine {
  std::int64_t time_ns = 0;   // robot clock, nanoseconds since the Unix epoch
  std::optional<Pose2> pose;  // at that time; lines of type pose have nothing else
  std::variant<std::monostate, Scan, GasReading, PoseCorrection, RobotStatus> reading;
};

// Reads one line of JSON; the format is in docs/robots.md. kInvalidArgument naming what is wrong.
absl::StatusOr<RobotLine> ParseRobotLine(absl::string_view line);

// The line that commands a twist, with its newline.
std::string FormatTwistLine(const Twist& twist);

}  // namespace plumescout::client
