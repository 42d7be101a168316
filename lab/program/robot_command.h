// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CLI/CLI.hpp"
#include "absl/status/status.h"

namespace plumescout::lab {

// `plumescout-lab robot`: drives a simulated robot through a scene, planned by a server over gRPC,
// and leaves a folder of results. `status` is set when the command has run.
void AddRobotCommand(CLI::App& app, absl::Status& status);

}  // namespace plumescout::lab
