// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "lab/bench/bench_summary.h"

namespace plumescout::lab {

struct TeamFlags {
  int robots = 4;
  double seconds = 20.0;
  double scan_hz = 10.0;
};

// A team of robots with an operator watching the map: how long plans, maps and the gas posterior
// take.
absl::Status RunTeam(const TeamFlags& flags, const std::string& server_program,
                     BenchSummary& summary);

}  // namespace plumescout::lab
