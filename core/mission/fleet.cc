// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/fleet.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/mission/observation_check.h"
#include "core/mission/plan_goals.h"
#include "core/mission/sensor_check.h"
#include "core/types/checker.h"
#include "core/types/error_reason.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// A claim outlives its trajectory by this factor and this time before another robot may take it.
constexpr double kClaimSlack = 2.0;
constexpr double kClaimGrace_s = 30.0;
// Poses and beams err a little: the disc is wider than the robot by this much.
constexpr double kMaskMargin_m = 0.15;
constexpr double kMaxRadius_m = 5.0;
// Who is removed is remembered by its log and its lease: a few hundred bytes each.
constexpr std::size_t kMostRobotsEver = 4096;
// A robot whose way is blocked sees what blocks it within a metre ahead; both have driven on since
// their latest poses came.
constexpr double kMeeting_m = 1.5;

std::int64_t Nanoseconds(double seconds) { return std::llround(seconds * 1e9); }

absl::Status UnknownRobot(const RobotId& robot) {
  return absl::NotFoundError(absl::StrCat("robot \"", robot, "\" is not registered"));
}

void Want(const std::optional<Goal>& goal, std::int64_t now_ns, RobotRecord& record) {
  if (goal && !record.wanted_goal && record.wanted_since_ns == 0) record.wanted_since_ns = now_ns;
  record.wanted_goal = goal;
}

void WantNothing(RobotRecord& record) {
  record.wanted_goal.reset();
  record.wanted_since_ns = 0;
}

void GoOn(RobotRecord& record) {
  if (record.live_trajectory == nullptr) return;
  const std::optional<NearestTime> there =
      FindOnWay(*record.live_trajectory, record.state.pose.position(), record.live_gone_s);
  if (there) record.live_gone_s = there->time_s;
}

}  // namespace

Fleet::Fleet(double robot_silence_s, double low_battery_share)
    : silence_ns_(Nanoseconds(robot_silence_s)), low_battery_share_(low_battery_share) {}

const Fleet::Member* Fleet::Find(const RobotId& robot) const {
  const auto found = robots_.find(robot);
  return found == robots_.end() || found->second.removed ? nullptr : &found->second;
}

absl::Status Fleet::Register(const RobotRegistered& registration, int max_robot_count,
                             double pose_limit_m) {
  PLUMESCOUT_RETURN_IF_ERROR(ValidateId("robot", registration.robot));
  PLUMESCOUT_RETURN_IF_ERROR(Checker()
                                 .InRangeAbove("radius_m", registration.radius_m, 0.0, kMaxRadius_m)
                                 .InRangeBelow("log_epoch", registration.log_epoch, 0, kLogEpochEnd)
                                 .status());
  PLUMESCOUT_RETURN_IF_ERROR(Validate(registration.frame, pose_limit_m));
  PLUMESCOUT_RETURN_IF_ERROR(CheckSensors(registration.sensors));
  const auto found = robots_.find(registration.robot);
  const auto present = std::count_if(robots_.begin(), robots_.end(),
                                     [](const auto& entry) { return !entry.second.removed; });
  if (!Knows(registration.robot) && present >= max_robot_count) {
    return absl::ResourceExhaustedError(
        absl::StrCat("the mission has ", max_robot_count, " robots already"));
  }
  if (found == robots_.end() && robots_.size() >= kMostRobotsEver) {
    return absl::ResourceExhaustedError(absl::StrCat("the mission remembers ", kMostRobotsEver,
                                                     " robots already, removed ones too"));
  }
  if (found != robots_.end() && registration.lease_token <= found->second.lease_token) {
    return TypedError(absl::StatusCode::kFailedPrecondition, reason::kLeaseSuperseded,
                      absl::StrCat("lease_token = ", registration.lease_token,
                                   " must be newer than ", found->second.lease_token));
  }
  Member& member = robots_[registration.robot];
  member.record.state.id = registration.robot;
  member.record.state.radius_m = registration.radius_m;
  if (member.record.state.frame.mission_from_robot != registration.frame.mission_from_robot) {
    member.record.state.has_pose = false;
    member.odometer.Forget();
    EndPlan(member);
    WantNothing(member.record);
  }
  member.record.pose_ns = 0;
  member.record.state.frame = registration.frame;
  member.sensors = registration.sensors;
  for (const GasSensor& sensor : member.sensors) {
    has_offsets_ = has_offsets_ || sensor.offset_stddev_ppm > 0.0;
  }
  member.lease_token = registration.lease_token;
  if (registration.log_epoch != 0) member.log_epoch = registration.log_epoch;
  member.removed = false;
  return absl::OkStatus();
}

absl::StatusOr<GasSensor> Fleet::SensorOf(const RobotId& robot, int sensor) const {
  const std::vector<GasSensor>& sensors = robots_.at(robot).sensors;
  const int count = std::max(1, static_cast<int>(sensors.size()));
  PLUMESCOUT_RETURN_IF_ERROR(Checker().InRangeBelow("gas.sensor", sensor, 0, count).status());
  return sensors.empty() ? GasSensor() : sensors[static_cast<std::size_t>(sensor)];
}

absl::Status Fleet::Remove(const RobotId& robot) {
  Member* const member = Find(robot);
  if (member == nullptr) return UnknownRobot(robot);
  member->removed = true;
  member->heard_ns.reset();
  member->last_phase.reset();
  member->record.state.has_pose = false;
  member->record.state.silent = false;
  member->record.state.battery_share.reset();
  member->record.state.ordered_home = false;
  member->record.battery_low = false;
  EndPlan(*member);
  WantNothing(member->record);
  CompleteIfAllAre();
  return absl::OkStatus();
}

void Fleet::Hear(const RobotId& robot, std::int64_t now_ns) {
  for (auto& [id, member] : robots_) {
    if (member.removed) continue;
    if (id == robot) {
      member.heard_ns = now_ns;
      member.record.state.silent = false;
    } else if (!member.heard_ns) {
      member.heard_ns = now_ns;
    } else if (!member.record.state.silent && now_ns - *member.heard_ns > silence_ns_) {
      FallSilent(member);
    }
  }
}

bool Fleet::IsAnyLastHeardIn(std::int64_t first_ns, std::int64_t end_ns) const {
  return std::any_of(robots_.begin(), robots_.end(), [&](const auto& entry) {
    const std::optional<std::int64_t>& heard_ns = entry.second.heard_ns;
    return heard_ns && *heard_ns >= first_ns && *heard_ns < end_ns;
  });
}

// A robot that was told that the mission is complete keeps nobody from completing it.
void Fleet::FallSilent(Member& member) {
  member.record.state.silent = true;
  EndPlan(member);
  WantNothing(member.record);
  if (member.last_phase != MissionPhase::kComplete) member.last_phase.reset();
  CompleteIfAllAre();
}

void Fleet::EndPlan(Member& member) {
  member.live.reset();
  member.record.live_trajectory = nullptr;
  member.record.live_goal.reset();
  member.record.live_arrival_ns = 0;
  member.record.live_gone_s = 0.0;
  member.record.assigned_plan = 0;
}

absl::Status Fleet::CheckSequence(const RobotId& robot, const Observation& observation) const {
  const Member* const member = Find(robot);
  if (member == nullptr) return UnknownRobot(robot);
  const std::int64_t expected = member->record.state.applied_sequence + 1;
  PLUMESCOUT_RETURN_IF_ERROR(Checker().AtLeast("sequence", observation.sequence, 1).status());
  if (observation.sequence < expected && LastSequence(observation) < expected) {
    return absl::AlreadyExistsError(
        absl::StrCat("sequence = ", observation.sequence, " is applied already"));
  }
  if (const auto* gap = std::get_if<SequenceGap>(&observation.payload)) {
    if (gap->first_sequence != observation.sequence || gap->last_sequence < gap->first_sequence) {
      return absl::InvalidArgumentError(absl::StrCat(
          "gap = [", gap->first_sequence, ", ", gap->last_sequence,
          "] must begin at sequence = ", observation.sequence, " and not end earlier"));
    }
    if (gap->first_sequence <= expected) return absl::OkStatus();
  }
  if (observation.sequence != expected) {
    return TypedError(absl::StatusCode::kFailedPrecondition, reason::kSequenceGap,
                      absl::StrCat("expected ", expected, ", got ", observation.sequence));
  }
  return absl::OkStatus();
}

Pose2 Fleet::InMission(const RobotId& robot, const Pose2& pose) const {
  return plumescout::InMission(robots_.at(robot).record.state.frame, pose);
}

void Fleet::Advance(const RobotId& robot, const Observation& observation, bool refused) {
  Member& member = robots_.at(robot);
  RobotState& state = member.record.state;
  state.applied_sequence = LastSequence(observation);
  const std::int64_t time_ns = plumescout::MissionTime_ns(observation, state.clock_offset_ns);
  if (!refused && SaysWhen(observation)) member.clock.Take(time_ns);
  if (refused) {
    ++state.rejected_observations;
  } else if (const auto* status = std::get_if<RobotStatus>(&observation.payload)) {
    TakeStatus(*status, member);
  } else if (!std::holds_alternative<SequenceGap>(observation.payload)) {
    state.pose = plumescout::InMission(state.frame, observation.pose);
    state.pose.yaw_rad = WrapAngle_rad(state.pose.yaw_rad);
    state.has_pose = true;
    member.record.pose_ns = time_ns;
    GoOn(member.record);
    if (std::holds_alternative<PoseCorrection>(observation.payload)) {
      member.odometer.GoOnFrom(state.pose.position());
    }
    member.odometer.Pass(state.pose.position());
    member.record.travelled_m = member.odometer.travelled_m();
    if (!member.record.first_place) {
      member.record.first_place = state.pose.position();
      member.first_ns = time_ns;
    }
  }
}

std::optional<GoalClaim> Fleet::FindClaim(const Plan& plan, std::int64_t now_ns,
                                          const std::set<RobotId>& stopped) const {
  const std::optional<Goal> goal = GoalToClaim(plan);
  if (!goal) return std::nullopt;
  for (const GoalClaim& claim : Claims(now_ns)) {
    if (claim.robot == plan.robot || stopped.contains(claim.robot)) continue;
    if (IsSameErrand(claim.goal, *goal)) return claim;
  }
  return std::nullopt;
}

absl::StatusOr<PlanId> Fleet::Issue(const Plan& plan, std::int64_t now_ns, bool assigned) {
  Member* const planner = Find(plan.robot);
  if (planner == nullptr) return UnknownRobot(plan.robot);
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker().InRangeBelow("chosen", plan.chosen, -1, plan.candidates.size()).status());
  LivePlan live{next_plan_, plan.phase, GoalToClaim(plan),
                now_ns + Nanoseconds(plan.trajectory.duration_s * kClaimSlack + kClaimGrace_s),
                std::nullopt};
  live.handed_back = IsSentHome(planner->record);
  if (SamplesSites(plan)) live.map_update_ns = now_ns + Nanoseconds(plan.trajectory.duration_s);
  if (live.goal) {
    for (const GoalClaim& claim : Claims(now_ns)) {
      if (claim.robot != plan.robot && ClaimCovers(claim.goal, *live.goal)) {
        return absl::AbortedError(absl::StrCat("the goal is claimed by robot \"", claim.robot,
                                               "\" with plan ", claim.plan));
      }
    }
  }
  if (!assigned) Hear(plan.robot, now_ns);
  Member& member = *planner;
  ++next_plan_;
  ++member.record.plans_issued;
  member.record.last_plan = live.id;
  if (plan.phase == MissionPhase::kExploring || plan.phase == MissionPhase::kGasProbing) {
    member.record.fruitless_fallbacks = 0;
  }
  // Who is sent home when all is done, or makes way, takes nothing up again.
  const bool all_done = IsSentHome(member.record) ? phase_ == MissionPhase::kComplete
                                                  : member.last_phase == MissionPhase::kComplete;
  const std::optional<Goal> chosen = ChosenGoal(plan);
  const bool stays_complete = (plan.phase == MissionPhase::kReturning && all_done) ||
                              (MakesWay(chosen) && member.last_phase == MissionPhase::kComplete);
  if (!stays_complete) {
    member.last_phase = plan.phase;
    UpdatePhase(plan.phase);
  }
  member.live = std::move(live);
  member.record.live_trajectory =
      plan.chosen < 0 ? nullptr : std::make_shared<const Trajectory>(plan.trajectory);
  member.record.live_goal = chosen;
  member.record.live_arrival_ns = now_ns + Nanoseconds(plan.trajectory.duration_s);
  member.record.live_gone_s = 0.0;
  member.record.assigned_plan = assigned ? member.record.last_plan : 0;
  if (chosen && !MakesWay(chosen)) WantNothing(member.record);
  Want(WantedGoal(plan), now_ns, member.record);
  return member.record.last_plan;
}

absl::StatusOr<EndedPlan> Fleet::Report(const ProgressReported& report) {
  Member* const reporter = Find(report.robot);
  if (reporter == nullptr) return UnknownRobot(report.robot);
  Member& member = *reporter;
  if (report.plan_id < 1 || report.plan_id >= next_plan_) {
    return absl::NotFoundError(absl::StrCat("plan ", report.plan_id, " was never issued"));
  }
  if (report.plan_id != member.record.last_plan) {
    return TypedError(absl::StatusCode::kFailedPrecondition, reason::kPlanSuperseded,
                      absl::StrCat("plan ", report.plan_id, " is not robot \"", report.robot,
                                   "\"'s latest, ", member.record.last_plan));
  }
  if (!member.live) {
    return absl::AlreadyExistsError(absl::StrCat("plan ", report.plan_id, " has ended already"));
  }
  const LivePlan live = *member.live;
  // A place that was not reached says nothing of what can be seen from there, and who made way did
  // not look.
  const bool reached =
      report.outcome == ProgressOutcome::kReached && !MakesWay(member.record.live_goal);
  EndPlan(member);
  if (live.phase == MissionPhase::kFallback && reached) ++member.record.fruitless_fallbacks;
  return EndedPlan{live.goal, OthersNear(member)};
}

// Bodies nearer than kMeeting_m. Who is silent counts as gone: its body, if it is there, is a wall.
bool Fleet::OthersNear(const Member& member) const {
  const RobotState& state = member.record.state;
  return std::any_of(robots_.begin(), robots_.end(), [&](const auto& entry) {
    const RobotState& other = entry.second.record.state;
    return other.id != state.id && state.has_pose && other.has_pose && !other.silent &&
           Distance_m(state.pose.position(), other.pose.position()) <
               state.radius_m + other.radius_m + kMeeting_m;
  });
}

void Fleet::UpdatePhase(MissionPhase latest) {
  if (latest == MissionPhase::kComplete) {
    CompleteIfAllAre();
  } else {
    phase_ = latest;
  }
}

// The mission is complete when every robot that ever planned, and has neither left nor fallen
// silent nor been sent home since, was told so last.
void Fleet::CompleteIfAllAre() {
  bool any = false;
  for (const auto& [id, member] : robots_) {
    if (!member.last_phase || IsSentHome(member.record)) continue;
    if (*member.last_phase != MissionPhase::kComplete) return;
    any = true;
  }
  if (any) phase_ = MissionPhase::kComplete;
}

absl::StatusOr<std::int64_t> Fleet::AppliedSequence(const RobotId& robot) const {
  const Member* const member = Find(robot);
  if (member == nullptr) return UnknownRobot(robot);
  return member->record.state.applied_sequence;
}

absl::StatusOr<std::int64_t> Fleet::LeaseToken(const RobotId& robot) const {
  const Member* const member = Find(robot);
  if (member == nullptr) return UnknownRobot(robot);
  return member->lease_token;
}

bool Fleet::LogContinues(const RobotId& robot, std::int64_t log_epoch) const {
  const auto found = robots_.find(robot);
  if (found == robots_.end() || found->second.record.state.applied_sequence == 0) return true;
  const std::int64_t known_epoch = found->second.log_epoch;
  return log_epoch == 0 || known_epoch == 0 || log_epoch == known_epoch;
}

std::vector<MaskDisc> Fleet::MasksFor(const RobotId& observer) const {
  std::vector<MaskDisc> masks;
  for (const auto& [id, member] : robots_) {
    const RobotState& state = member.record.state;
    if (id == observer || !state.has_pose || state.silent) continue;
    masks.push_back({state.pose.position(), state.radius_m + kMaskMargin_m});
  }
  return masks;
}

std::map<RobotId, RobotRecord> Fleet::Records() const {
  std::map<RobotId, RobotRecord> records;
  for (const auto& [id, member] : robots_) {
    if (member.removed) continue;
    RobotRecord& record = records[id] = member.record;
    record.heard_ns = member.heard_ns.value_or(0);
  }
  return records;
}

std::vector<RobotId> Fleet::Ids() const {
  std::vector<RobotId> ids;
  for (const auto& [id, member] : robots_) {
    if (!member.removed) ids.push_back(id);
  }
  return ids;
}

std::optional<std::int64_t> Fleet::NextMapUpdate_ns(std::int64_t now_ns) const {
  std::optional<std::int64_t> next_ns;
  for (const auto& [id, member] : robots_) {
    if (!member.live || !member.live->map_update_ns || member.live->expires_ns <= now_ns) continue;
    const std::int64_t due_ns = std::max(now_ns, *member.live->map_update_ns);
    next_ns = std::min(next_ns.value_or(due_ns), due_ns);
  }
  return next_ns;
}

std::vector<GoalClaim> Fleet::Claims(std::int64_t now_ns) const {
  std::vector<GoalClaim> claims;
  for (const auto& [id, member] : robots_) {
    if (!member.live || !member.live->goal || member.live->expires_ns <= now_ns) continue;
    if (member.live->handed_back) continue;
    claims.push_back({id, member.live->id, *member.live->goal, member.live->expires_ns});
  }
  return claims;
}

}  // namespace plumescout
