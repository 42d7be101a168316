// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CLI/CLI.hpp"
#include "absl/status/status.h"

namespace plumescout::lab {

// `plumescout-lab scene make`: wind and gas in a building from its layout, as a scene folder.
// `status` is set when the command has run.
void AddSceneCommand(CLI::App& app, absl::Status& status);

}  // namespace plumescout::lab
