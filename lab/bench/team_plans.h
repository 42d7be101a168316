// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/status.h"
#include "lab/bench/bench_summary.h"

namespace plumescout::lab {

// Plans for all robots of a team at once, in the middle of missions of four and eight robots in
// 16 x 20 and 32 x 40 m: what one, three and as many orders as there are cost and are worth, beside
// robots that plan one after the other in the order of their names, each knowing those before it.
absl::Status MeasureTeams(BenchSummary& summary);

}  // namespace plumescout::lab
