// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "absl/status/status.h"
#include "lab/program/recording.h"

namespace plumescout::lab {

// Writes a recording as an MCAP file (formats/view/mission_mcap.h), which is there when it is
// whole, and only then; memory does not grow with the recording. `progress` is told the share that
// is done, and may be empty. Errors: those of reading and Replay; kUnavailable if the file cannot
// be written. REQUIRES: no event was read yet.
absl::Status ExportMcap(Recording& recording, const std::string& path, double map_period_s,
                        double map_share, const std::function<void(double)>& progress = {});

}  // namespace plumescout::lab
