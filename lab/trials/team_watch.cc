// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/team_watch.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/plan/anticipation.h"
#include "core/plan/blockade.h"
#include "core/plan/selection/expected_information.h"
#include "core/plan/selection/selection.h"

namespace plumescout::lab {
namespace {

// Bodies no farther apart than this may have been what was in the way: as missions have it.
constexpr double kNear_m = 1.5;
constexpr char kReportedBlocked[] = "reported blocked";

// The belief without the promises that were made after the plan: ids of a mission's plans rise.
// What later plans have taken the place of by now is missing too.
Belief WhenMade(const Belief& belief, const Plan& plan) {
  Belief then = belief;
  for (auto& [id, record] : then.robots) {
    if (record.last_plan > plan.id) record.live_trajectory = nullptr;
  }
  return then;
}

}  // namespace

int TeamWatch::Plight::Note(const std::set<RobotId>& robots, double now_s) {
  std::erase_if(spells_, [&](const auto& spell) { return !robots.contains(spell.first); });
  int lasted = 0;
  for (const RobotId& robot : robots) {
    Spell& spell = spells_.try_emplace(robot, Spell{now_s, false}).first->second;
    if (spell.told || now_s - spell.begun_s < kLong_s) continue;
    spell.told = true;
    ++lasted;
  }
  return lasted;
}

void TeamWatch::OnTime(const Belief& belief) {
  const std::vector<BlockedRobot> blocked =
      FindBlockedRobots(belief, belief.robots, belief.options->planning);
  std::set<RobotId> held_up;
  std::set<RobotId> first_of_ring;
  for (const BlockedRobot& one : blocked) {
    held_up.insert(one.robot);
    const std::vector<BlockedRobot> ring = FindRing(blocked, one.robot);
    if (!ring.empty()) first_of_ring.insert(ring.front().robot);
  }
  constexpr double kSecondsPerNanosecond = 1e-9;
  const double now_s = static_cast<double>(belief.sample_time_ns) * kSecondsPerNanosecond;
  findings_.held_up += held_up_.Note(held_up, now_s);
  findings_.deadlocks += ring_.Note(first_of_ring, now_s);
}

void TeamWatch::OnPlan(const Belief& belief, const Plan& plan) {
  CheckSetAside(belief, plan.robot);
  goals_.erase(plan.robot);
  if (plan.chosen < 0) return;
  goals_[plan.robot] = plan.candidates[static_cast<std::size_t>(plan.chosen)].goal;
  CheckUnseen(belief, plan);
  if (belief.gas_what_if != nullptr) Price(belief, plan);
}

void TeamWatch::OnLeg(const EndedLeg& leg, double radius_m) {
  blocked_.erase(leg.robot);
  const bool by_robot =
      leg.outcome == ProgressOutcome::kBlocked && leg.nearest_m < 2.0 * radius_m + kNear_m;
  if (!by_robot) return;
  ++findings_.blocked_by_robot;
  const auto goal = goals_.find(leg.robot);
  if (goal != goals_.end()) blocked_[leg.robot] = goal->second;
}

// The leg was reported just before this robot's plan was made.
void TeamWatch::CheckSetAside(const Belief& belief, const RobotId& robot) {
  const auto blocked = blocked_.find(robot);
  if (blocked == blocked_.end()) return;
  const bool is_set_aside =
      std::any_of(belief.set_aside.begin(), belief.set_aside.end(), [&](const SetAsideGoal& aside) {
        return aside.reason == kReportedBlocked && SamePlace(aside.goal, blocked->second);
      });
  if (is_set_aside) ++findings_.set_aside_for_robot;
  blocked_.erase(blocked);
}

void TeamWatch::CheckUnseen(const Belief& belief, const Plan& plan) {
  const Candidate& chosen = plan.candidates[static_cast<std::size_t>(plan.chosen)];
  if (!EndsAtTheUnseen(chosen)) return;
  ++findings_.unseen_goals;
  const Belief then = WhenMade(belief, plan);
  const bool is_in_sight =
      PromisedSight(then, plan.robot, lidar_range_m_).ShareOf(chosen.goal.centroid) > 0.0;
  if (is_in_sight) ++findings_.unseen_in_others_sight;
  if (!chosen.expected_information_nats) return;
  const PlanningOptions options = InField(belief.options->planning, belief.options->gas);
  const double paid_nats = chosen.unseen_share * options.unseen_information_nats;
  findings_.unseen_paid_nats += paid_nats;
  if (is_in_sight) findings_.unseen_paid_twice_nats += paid_nats;
}

void TeamWatch::Price(const Belief& belief, const Plan& plan) {
  const PlanningOptions& options = belief.options->planning;
  const Candidate& chosen = plan.candidates[static_cast<std::size_t>(plan.chosen)];
  const std::vector<Cell> readings = ReadingCells(chosen.path, belief.geometry(), options);
  const std::optional<double> alone_nats = ExpectedInformation(belief).Of(readings);
  if (!alone_nats) return;
  const std::optional<Belief> ahead = Anticipate(WhenMade(belief, plan), plan.robot, options);
  const std::optional<double> besides_nats =
      ahead ? ExpectedInformation(*ahead).Of(readings) : alone_nats;
  if (!besides_nats) return;
  findings_.alone_nats += *alone_nats;
  findings_.besides_nats += *besides_nats;
  if (!chosen.expected_information_nats) return;
  findings_.paid_nats += *chosen.expected_information_nats;
  findings_.paid_twice_nats += std::max(0.0, *chosen.expected_information_nats - *besides_nats);
}

}  // namespace plumescout::lab
