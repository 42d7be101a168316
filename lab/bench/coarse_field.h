// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/status.h"
#include "lab/bench/bench_summary.h"

namespace plumescout::lab {

// How far the field of open ground, side x side metres, on coarser lattices is from that on the
// full one, of the same readings: what is told of means and of their errors, near readings and away
// from them; and how far each is from the truth.
absl::Status MeasureCoarseFields(double side_m, BenchSummary& summary);

}  // namespace plumescout::lab
