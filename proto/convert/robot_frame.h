// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/robot_frame.h"
#include "plumescout/v1/robot_service.pb.h"

namespace plumescout {

v1::RobotFrame ToProto(const RobotFrame& frame);

// Coordinates must be finite, and standard deviations neither negative nor infinite; how large they
// may be is for the mission to say. Without a pose the frames differ by nothing.
absl::StatusOr<RobotFrame> FromProto(const v1::RobotFrame& proto, absl::string_view field);

}  // namespace plumescout
