// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "lab/trials/trial.h"
#include "lab/trials/trial_study.h"

namespace plumescout::lab {

// What a study tells of all trials of one row of teams, beside those of another row with the same
// buildings and seeds.

// How many times sooner the row is there; geometric means.
struct Speedup {
  double entropy = 1.0;  // at 80 % of what the other row gains in its whole run
  double rmse = 1.0;     // likewise
  double map = 1.0;      // at 95 % of the map
  double half_rmse = 1.0;
  int censored = 0;  // runs that did not get to one of the first three; they count with their ends
  int pairs = 0;     // of runs that were compared
  // Of those, in how many both got there. Where few did, a figure near 1 says nothing.
  int map_pairs = 0;
  int half_rmse_pairs = 0;
};
Speedup SpeedupOf(const std::vector<SceneRecords>& records, std::size_t row, std::size_t other_row);

// Sums over all trials of a row.
struct Traffic {
  TeamRecord sums;           // but of closest_m the least
  double plan_wall_s = 0.0;  // mean of medians
  int missions = 0;
  int deadlocked_missions = 0;

  double blocked_share() const;           // of legs
  double blocked_by_robot_share() const;  // of legs
  double encounters_per_robot_minute() const;
  double waiting_share() const;  // of robots' time, by plan
  // Of what chosen ways tell: promised by live plans of others already, whether it was paid or not.
  double promised_share() const;
  // Of what chosen ways were priced at: what live plans of others had promised already.
  double bought_twice_share() const;
  // Of ways to the edge of the unseen: live plans of others are to see that edge.
  double unseen_twice_share() const;
  // Of all that was paid, edges of the unseen included: bought twice, as if others saw all of every
  // edge that is in their sight.
  double all_bought_twice_share() const;
};
Traffic TrafficOf(const std::vector<SceneRecords>& records, std::size_t row);

}  // namespace plumescout::lab
