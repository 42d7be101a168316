// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "absl/status/statusor.h"
#include "lab/trials/mission_moments.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// [XIT] Fig. 7: one mission of XIT-GFF with the UCB cost in a hall of 16 m x 20 m, in six moments.
absl::StatusOr<Study> RunXitEpisode(const ExperimentOptions& options);

// What the caption of Fig. 7 says of its six pictures.
enum class MomentKind { kFirstFrontier, kFirstGasFrontier, kAlternation, kExploitation };

struct ChosenMoment {
  MomentKind kind;
  std::size_t index;  // of the mission's moments
};

// A trajectory against the shortest way to its goal.
struct Detour {
  std::vector<Point2> shortest;
  double length_ratio = 1.0;     // of the trajectory over the shortest way
  double mean_ucb = 0.0;         // on the trajectory
  double shortest_mean_ucb = 0;  // on the shortest way
};

// (a) the first trajectory to an occupancy frontier; (b) the first to a gas frontier; (c)-(e)
// trajectories with which the mission turns from one kind to the other, spread over the time that
// is left; (f) in the second half, the detour that gains most UCB over the shortest way. In order
// of time; fewer if the mission has no such moments. `detours` holds one for each moment.
std::vector<ChosenMoment> ChooseMoments(const std::vector<MissionMoment>& moments,
                                        const std::vector<Detour>& detours);

}  // namespace plumescout::lab
