// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// What robots are worth together: one, two, four and eight that share a mission, in buildings of
// some 20 m and some 35 m, from one door. How much sooner they know the building and its gas, how
// often they are in each other's way, also if they are late, what is promised twice, what a plan
// costs; and whether they get stuck where all doors and lanes are for one. Bodies block each other.
absl::StatusOr<Study> RunTeamStudy(const ExperimentOptions& options);

}  // namespace plumescout::lab
