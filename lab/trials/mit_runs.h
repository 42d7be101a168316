// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/plan/paths/path_planner.h"
#include "core/types/pose2.h"
#include "lab/worlds/mit_scene.h"

namespace plumescout::lab {

// Of Table I and Fig. 2.
inline constexpr std::size_t kTrajectories = 3;

// A planner of [MIT] Table I with what the paper prints for it, in percent.
struct MitRival {
  std::string name;
  std::unique_ptr<const PathPlanner> planner;
  std::array<double, 3> paper_shares_percent;  // NaN: not in the paper
};

// Samples of a search with MIT; the trees of the others draw as many on average in the scene of the
// table, which their step length was chosen for.
inline constexpr int kMitSamples = 270;
// Radius of the discs that end RRT and RRT*, metres: as far as the k_n-th of N even samples lies
// from a goal, (k_n A / (pi N))^(1/2) on the 70 m2 that can be reached; where MIT's paths end.
inline constexpr double kGoalRadius_m = 0.5;

// MIT as published, with samples drawn from Eq. (2) of the scene; RRT; RRT*; and (ours) MIT with
// samples that know nothing of the gas, and with samples of I-hat, as [XIT] draws them.
std::vector<MitRival> MitRivals(const MitScene& scene);

// One search.
struct MitRun {
  std::array<std::vector<Point2>, 3> paths;  // by goal; empty if none was found
  std::array<double, 3> length_m{};          // NaN likewise
  std::array<double, 3> psi{};               // Eq. (3), of the field as I-hat; NaN likewise
  int best = -1;                             // the trajectory with the greatest psi; -1: no path
  int samples = 0;
};

// `runs` searches of one planner in one scene, with seeds that follow from `seed`. `done` is told
// after each; may be empty.
std::vector<MitRun> RunMitRival(const MitRival& rival, const MitScene& scene, int runs,
                                std::uint64_t seed, const std::function<void()>& done);

// What a number of runs says.
struct MitSummary {
  int runs = 0;
  std::array<int, 3> best{};    // in how many runs the trajectory was the most informative
  std::array<double, 3> psi{};  // means over the runs that found it; NaN if none did
  std::array<double, 3> length_m{};
  std::array<int, 3> found{};
  double chosen_psi = 0.0;  // mean of the best trajectory's
  double samples = 0.0;     // mean

  double share(std::size_t trajectory) const {
    return static_cast<double>(best[trajectory]) / static_cast<double>(runs);
  }
};
// REQUIRES: runs not empty.
MitSummary Summarise(const std::vector<MitRun>& runs);

// Index of the most typical path: the one with the least mean distance to the others, from points
// at equal shares of the length. -1 if there is none.
int MostTypical(const std::vector<const std::vector<Point2>*>& paths);

}  // namespace plumescout::lab
