// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "absl/status/statusor.h"
#include "client/ros2/ros2_flags.h"

namespace plumescout::client {

using SayFn = std::function<void(const std::string&)>;

// Listens to a robot until everything that a mission needs has come, for so long at most, and says
// what is missing. Whether everything is there.
absl::StatusOr<bool> CheckRobot(ListenFlags flags, double seconds, const SayFn& say);

}  // namespace plumescout::client
