// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/belief/belief.h"
#include "core/mission/clock_history.h"
#include "core/mission/odometer.h"
#include "core/mission/way_correction.h"
#include "core/occupancy/scan_inserter.h"
#include "core/types/event.h"
#include "core/types/options.h"

namespace plumescout {

// The plan that a report ended.
struct EndedPlan {
  std::optional<Goal> goal;  // none: the robot stayed where it was, or drove home
  bool others_near = false;  // another robot was so near that it may have been what was in the way
};

// The robots of a mission: leases, logs, live plans, and how far each has driven.
//
// Invariants: 1. a robot has at most one live plan. 2. no two live, unexpired plans of different
// robots end at the same goal. Thread-compatible.
// A robot that is not heard of for `robot_silence_s` while others are is silent: its mask, its
// claim and its vote on whether the mission is complete lapse, by sample time alone. It is silent
// no more when it is heard of again; its plan has ended then.
class Fleet {
 public:
  // `low_battery_share`: see MissionOptions::return_home_below_battery_share.
  explicit Fleet(double robot_silence_s = MissionOptions().robot_silence_s,
                 double low_battery_share = MissionOptions().return_home_below_battery_share);

  // `pose_limit_m`: of the place of its frame. A robot whose frame is put elsewhere has no pose
  // until it tells one, and its live plan, made from where it was taken to be, ends.
  // kResourceExhausted also if so many were there ever, removed ones included, that no more can be
  // remembered.
  absl::Status Register(const RobotRegistered& registration, int max_robot_count,
                        double pose_limit_m = MissionOptions().pose_limit_m);

  // The robot leaves: it is unknown until it registers again, and then goes on with its log.
  absl::Status Remove(const RobotId& robot);

  // From its frame to frame map. REQUIRES: Knows(robot).
  Pose2 InMission(const RobotId& robot, const Pose2& pose) const;
  // REQUIRES: Knows(robot).
  const RobotState& StateOf(const RobotId& robot) const { return robots_.at(robot).record.state; }
  void Suspect(const RobotId& robot, bool suspect) {
    robots_.at(robot).record.state.frame_suspect = suspect;
  }

  // Where its first observation was taken, and when; none before there is one. REQUIRES:
  // Knows(robot).
  std::optional<WayPoint> StartOf(const RobotId& robot) const;
  // Where it was last, and when; none before it has told since it registered. REQUIRES:
  // Knows(robot).
  std::optional<WayPoint> LatestOf(const RobotId& robot) const;
  // That was elsewhere. REQUIRES: StartOf(robot).
  void MoveStart(const RobotId& robot, Point2 place) {
    robots_.at(robot).record.first_place = place;
  }

  // How far the mission's time is ahead of the robot's clock from now on; kInvalidArgument beyond
  // kMaxClockOffset_ns.
  absl::Status NoteClock(const ClockOffsetNoted& noted);
  // When an observation of that time of the robot's clock was taken. REQUIRES: Knows(robot).
  std::int64_t MissionTime_ns(const RobotId& robot, std::int64_t robot_ns) const;
  // A robot that is sent home claims no goal, and no mission waits for it to be complete. Its live
  // plan stays until it reports or has another: it drives there still.
  absl::Status OrderHome(const HomeOrdered& order);

  // The robot was heard of at the latest sample time; who was not for too long falls silent.
  void Hear(const RobotId& robot, std::int64_t now_ns);
  // Whether there is a robot that was last heard of at a time in [first_ns, end_ns).
  bool IsAnyLastHeardIn(std::int64_t first_ns, std::int64_t end_ns) const;

  // Checks that the observation is the next of the robot's log; see Mission::Apply for the errors.
  absl::Status CheckSequence(const RobotId& robot, const Observation& observation) const;
  // Moves the robot's log past the observation, whose pose is in the robot's frame. REQUIRES:
  // CheckSequence was OK.
  void Advance(const RobotId& robot, const Observation& observation, bool refused);

  // Gives the plan its number and makes it the robot's live plan. kAborted if another robot's live
  // plan claims the goal.
  // `assigned`: others ordered it.
  absl::StatusOr<PlanId> Issue(const Plan& plan, std::int64_t now_ns, bool assigned = false);
  // The live plan of another robot that ends where this one does, whatever for (IsSameErrand);
  // those of `stopped` are passed over.
  std::optional<GoalClaim> FindClaim(const Plan& plan, std::int64_t now_ns,
                                     const std::set<RobotId>& stopped = {}) const;
  // Ends the robot's live plan.
  absl::StatusOr<EndedPlan> Report(const ProgressReported& report);

  absl::StatusOr<std::int64_t> AppliedSequence(const RobotId& robot) const;
  absl::StatusOr<std::int64_t> LeaseToken(const RobotId& robot) const;
  // Whether the robot's numbers up to the applied one are of the log of that epoch; see
  // RobotRegistered::log_epoch. So is an empty log, and one of which either side does not say.
  bool LogContinues(const RobotId& robot, std::int64_t log_epoch) const;
  // As it registered; kInvalidArgument naming the field if the robot has no such sensor. REQUIRES:
  // the robot is known.
  absl::StatusOr<GasSensor> SensorOf(const RobotId& robot, int sensor) const;
  // Whether any robot ever registered a sensor whose offset is not known.
  bool has_offsets() const { return has_offsets_; }
  bool Knows(const RobotId& robot) const { return Find(robot) != nullptr; }
  // Whether it has a live plan that leads somewhere.
  bool HasWay(const RobotId& robot) const {
    const Member* const member = Find(robot);
    return member != nullptr && member->record.live_trajectory != nullptr;
  }
  std::vector<RobotId> Ids() const;

  // Discs around the latest poses of all robots but `observer` and the silent, in which beams must
  // not end.
  std::vector<MaskDisc> MasksFor(const RobotId& observer) const;

  std::map<RobotId, RobotRecord> Records() const;
  std::vector<GoalClaim> Claims(std::int64_t now_ns) const;
  MissionPhase Phase() const { return phase_; }
  // When the first of the live plans that sample sites has its last sample; none without such a
  // plan. One that is late is due now, until its claim expires.
  std::optional<std::int64_t> NextMapUpdate_ns(std::int64_t now_ns) const;

  // See core/types/byte_archive.h.
  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self);

 private:
  struct LivePlan {
    PlanId id = 0;
    MissionPhase phase = MissionPhase::kExploring;
    std::optional<Goal> goal;  // none: the robot stays where it is, or drives home
    std::int64_t expires_ns = 0;
    std::optional<std::int64_t> map_update_ns;  // of plans that sample sites
    bool handed_back = false;                   // the goal is free for others

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };
  struct Member {
    RobotRecord record;
    Odometer odometer;
    std::int64_t lease_token = 0;
    std::int64_t log_epoch = 0;
    std::optional<MissionPhase> last_phase;
    std::optional<LivePlan> live;
    std::optional<std::int64_t> heard_ns;  // none: no time has passed since it registered
    std::vector<GasSensor> sensors;
    bool removed = false;       // only its log and its lease are remembered
    std::int64_t first_ns = 0;  // when its first observation was taken
    ClockHistory clock;

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };

  const Member* Find(const RobotId& robot) const;  // null if unknown
  Member* Find(const RobotId& robot) {
    return const_cast<Member*>(std::as_const(*this).Find(robot));
  }
  static void EndPlan(Member& member);
  void HandBackClaim(Member& member);
  void TakeStatus(const RobotStatus& status, Member& member);
  bool OthersNear(const Member& member) const;
  void FallSilent(Member& member);
  void UpdatePhase(MissionPhase latest);
  void CompleteIfAllAre();

  std::int64_t silence_ns_;
  double low_battery_share_;
  std::map<RobotId, Member> robots_;
  PlanId next_plan_ = 1;
  bool has_offsets_ = false;
  MissionPhase phase_ = MissionPhase::kExploring;
};

}  // namespace plumescout
