// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/team_figures.h"

#include <algorithm>
#include <iterator>

#include "lab/trials/row_figures.h"
#include "lab/trials/statistics.h"
#include "lab/trials/team_times.h"

namespace plumescout::lab {
namespace {

constexpr double kShareOfGain = 0.8;
constexpr double kMostOfTheMap = 0.95;
constexpr double kHalf = 0.5;

void AddTeamRecord(const TeamRecord& team, TeamRecord& sums) {
  sums.legs += team.legs;
  sums.blocked_legs += team.blocked_legs;
  sums.contacts += team.contacts;
  sums.encounters += team.encounters;
  sums.waiting_s += team.waiting_s;
  sums.robot_s += team.robot_s;
  if (team.closest_m) {
    sums.closest_m = std::min(sums.closest_m.value_or(*team.closest_m), *team.closest_m);
  }
  sums.findings.blocked_by_robot += team.findings.blocked_by_robot;
  sums.findings.set_aside_for_robot += team.findings.set_aside_for_robot;
  sums.findings.deadlocks += team.findings.deadlocks;
  sums.findings.held_up += team.findings.held_up;
  sums.findings.alone_nats += team.findings.alone_nats;
  sums.findings.besides_nats += team.findings.besides_nats;
  sums.findings.paid_nats += team.findings.paid_nats;
  sums.findings.paid_twice_nats += team.findings.paid_twice_nats;
  sums.findings.unseen_goals += team.findings.unseen_goals;
  sums.findings.unseen_in_others_sight += team.findings.unseen_in_others_sight;
  sums.findings.unseen_paid_nats += team.findings.unseen_paid_nats;
  sums.findings.unseen_paid_twice_nats += team.findings.unseen_paid_twice_nats;
}

}  // namespace

Speedup SpeedupOf(const std::vector<SceneRecords>& records, std::size_t row,
                  std::size_t other_row) {
  std::vector<double> ratios[4];
  int both[4] = {};
  Speedup speedup;
  constexpr MetricFn kFalling[] = {EntropyPerCell_nats, Rmse_ppm};
  for (const SceneRecords& scene : records) {
    for (std::size_t k = 0; k < scene[row].size(); ++k) {
      const std::vector<CurvePoint>& other = scene[other_row][k].curve;
      const std::vector<CurvePoint>& team = scene[row][k].curve;
      const auto compare = [&](std::size_t figure, const ReachedAt& a, const ReachedAt& b) {
        constexpr double kLeast_s = 1.0;
        ratios[figure].push_back(std::max(kLeast_s, a.time_s) / std::max(kLeast_s, b.time_s));
        if (a.reached && b.reached) ++both[figure];
        return b.reached;
      };
      ++speedup.pairs;
      bool reached = true;
      for (std::size_t i = 0; i < std::size(kFalling); ++i) {
        const double level = LevelAtShare(other, kFalling[i], kShareOfGain);
        reached &=
            compare(i, FallsTo(other, kFalling[i], level), FallsTo(team, kFalling[i], level));
      }
      reached &= compare(2, RisesTo(other, Completeness, kMostOfTheMap),
                         RisesTo(team, Completeness, kMostOfTheMap));
      const double half_ppm = kHalf * Rmse_ppm(other.front().metrics);
      compare(3, FallsTo(other, Rmse_ppm, half_ppm), FallsTo(team, Rmse_ppm, half_ppm));
      if (!reached) ++speedup.censored;
    }
  }
  speedup.entropy = GeometricMean(ratios[0]);
  speedup.rmse = GeometricMean(ratios[1]);
  speedup.map = GeometricMean(ratios[2]);
  speedup.half_rmse = GeometricMean(ratios[3]);
  speedup.map_pairs = both[2];
  speedup.half_rmse_pairs = both[3];
  return speedup;
}

double Traffic::blocked_share() const {
  return static_cast<double>(sums.blocked_legs) / std::max(1, sums.legs);
}

double Traffic::blocked_by_robot_share() const {
  return static_cast<double>(sums.findings.blocked_by_robot) / std::max(1, sums.legs);
}

double Traffic::encounters_per_robot_minute() const {
  constexpr double kSecondsPerMinute = 60.0;
  return kSecondsPerMinute * sums.encounters / std::max(1.0, sums.robot_s);
}

double Traffic::waiting_share() const { return sums.waiting_s / std::max(1.0, sums.robot_s); }

double Traffic::promised_share() const {
  const TeamFindings& findings = sums.findings;
  return findings.alone_nats > 0.0 ? 1.0 - findings.besides_nats / findings.alone_nats : 0.0;
}

double Traffic::bought_twice_share() const {
  const TeamFindings& findings = sums.findings;
  return findings.paid_nats > 0.0 ? findings.paid_twice_nats / findings.paid_nats : 0.0;
}

double Traffic::unseen_twice_share() const {
  const TeamFindings& findings = sums.findings;
  return static_cast<double>(findings.unseen_in_others_sight) / std::max(1, findings.unseen_goals);
}

double Traffic::all_bought_twice_share() const {
  const TeamFindings& findings = sums.findings;
  const double paid_nats = findings.paid_nats + findings.unseen_paid_nats;
  const double twice_nats = findings.paid_twice_nats + findings.unseen_paid_twice_nats;
  return paid_nats > 0.0 ? twice_nats / paid_nats : 0.0;
}

Traffic TrafficOf(const std::vector<SceneRecords>& records, std::size_t row) {
  Traffic traffic;
  std::vector<double> walls_s;
  for (const SceneRecords& scene : records) {
    for (const TrialRecord& trial : scene[row]) {
      AddTeamRecord(trial.team, traffic.sums);
      walls_s.push_back(trial.team.plan_wall_s);
      ++traffic.missions;
      if (trial.team.findings.deadlocks > 0) ++traffic.deadlocked_missions;
    }
  }
  traffic.plan_wall_s = SpreadOf(walls_s).mean;
  return traffic;
}

}  // namespace plumescout::lab
