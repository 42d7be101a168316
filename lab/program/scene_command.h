// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CLI/CLI.hpp"
#include "absl/status/status.h"

namespace plumescout::lab {

// `plumescout-lab scene`: make, generate, show and import scene folders.
// `status` is set when the command has run.
void AddSceneCommand(CLI::App& app, absl::Status& status);

}  // namespace plumescout::lab
