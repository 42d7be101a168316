// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// Whether teams are better off with ours than with what others have robots choose by: in the first
// three small and two large buildings of RunTeamStudy, 2, 4 and 8 robots, 300 s, the same
// simulation, followers and start for all. Ours is beside robots that keep off each other's goals
// alone, robots on their own, and the rules of lab/rivals/team_rules.h. What is told is how much
// sooner than one robot of ours they are there, as in RunTeamStudy, and who was in whose way. With
// options.scenes: in these. Quick: one building, 30 s, one robot and two. Errors: as
// GeneratedScenes and RunTrials.
absl::StatusOr<Study> RunTeamRivals(const ExperimentOptions& options);

}  // namespace plumescout::lab
