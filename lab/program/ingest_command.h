// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "CLI/CLI.hpp"
#include "absl/status/status.h"

namespace plumescout::lab {

// `plumescout-lab ingest`: makes a mission of a recording of another system, a bag of rosbag2.
void AddIngestCommand(CLI::App& app, absl::Status& status);

}  // namespace plumescout::lab
