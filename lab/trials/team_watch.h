// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>

#include "core/belief/belief.h"
#include "core/types/ids.h"
#include "core/types/plan.h"
#include "lab/sim/episode.h"

namespace plumescout::lab {

// What robots of one mission did to each other.
struct TeamFindings {
  int blocked_by_robot = 0;  // legs that ended blocked with another robot near, as missions have it
  int set_aside_for_robot = 0;  // goals of those that were set aside
  // Rings of robots that waited for each other for kLong_s, and robots that for so long had no way
  // but past others that stood in it.
  int deadlocks = 0;
  int held_up = 0;
  // Of all chosen ways: what their readings tell, and what they tell beside those that live plans
  // of others promised before (see core/plan/anticipation.h).
  double alone_nats = 0.0;
  double besides_nats = 0.0;
  // Of those whose choice went by their information: the prices that they were chosen by, and by
  // how much each is above what its way tells beside those promises.
  double paid_nats = 0.0;
  double paid_twice_nats = 0.0;
  // Chosen ways to the edge of the unseen, and those whose edge others are to see on the way of
  // live plans made before.
  int unseen_goals = 0;
  int unseen_in_others_sight = 0;
  // What was paid for all those edges, and for those in sight, as if others saw all that hides
  // there. Of choices that went by information.
  double unseen_paid_nats = 0.0;
  double unseen_paid_twice_nats = 0.0;

  friend bool operator==(const TeamFindings&, const TeamFindings&) = default;
};

// Looks on while a mission runs. Beliefs are the mission's as they are when it is told something.
class TeamWatch {
 public:
  static constexpr double kLong_s = 10.0;

  explicit TeamWatch(double lidar_range_m) : lidar_range_m_(lidar_range_m) {}

  // Every second or so of sample time. Cost: that of FindBlockedRobots.
  void OnTime(const Belief& belief);
  // As a plan arrives, committed; others may have been since. Cost: that of Anticipate and of
  // pricing its way twice.
  void OnPlan(const Belief& belief, const Plan& plan);
  // As a leg ends, not reported yet. Robots have this radius.
  void OnLeg(const EndedLeg& leg, double radius_m);

  const TeamFindings& findings() const { return findings_; }

 private:
  // Who is in a plight, and since when.
  class Plight {
   public:
    // Who is in it now; returns of how many it has lasted kLong_s, each told once.
    int Note(const std::set<RobotId>& robots, double now_s);

   private:
    struct Spell {
      double begun_s = 0.0;
      bool told = false;
    };
    std::map<RobotId, Spell> spells_;
  };

  void CheckSetAside(const Belief& belief, const RobotId& robot);
  void Price(const Belief& belief, const Plan& plan);
  void CheckUnseen(const Belief& belief, const Plan& plan);

  double lidar_range_m_;
  TeamFindings findings_;
  Plight ring_;
  Plight held_up_;
  std::map<RobotId, Goal> goals_;    // of latest plans
  std::map<RobotId, Goal> blocked_;  // by a robot, on the latest leg
};

}  // namespace plumescout::lab
