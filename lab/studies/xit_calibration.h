// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"
#include "lab/trials/trial_study.h"

namespace plumescout::lab {

// The robot of all rows of Table III: gas as the sensor tells it, 0.74 s for each plan ([XIT]
// section VI-B), and a LiDAR whose range the paper does not print.
TrialRobot CalibratedRobot();

// What that row does in our hall by the range of the LiDAR, beside what the paper prints of it: the
// robot of Table III is chosen by this, and by no other row. The rule, from before anybody looked:
// the shortest range with which the map is complete to 98 % when half of the time is over (the
// paper: "near-complete coverage by the halfway mark"); the hall stays if the baseline's error with
// it is within the paper's 20.0 +- 4.4 ppm. Five trials of 300 s each, with seeds that Table III
// does not use. Quick: one of 60 s. Errors: as HallScene and RunTrials.
absl::StatusOr<Study> RunXitCalibration(const ExperimentOptions& options);

}  // namespace plumescout::lab
