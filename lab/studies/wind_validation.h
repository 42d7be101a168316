// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// The solver behind our wind on flows that are known: the cavity with a sliding lid at Re = 100 and
// 400 (Ghia et al. 1982), the channel (Poiseuille; entrance after Durst et al. 2005), the
// backward-facing step at Re = 100 and 200 (Erturk 2008), each on several rasters. Nothing is drawn
// at random. Quick: coarse rasters, 2 s; else 90 s.
absl::StatusOr<Study> RunWindValidation(const ExperimentOptions& options);

}  // namespace plumescout::lab
