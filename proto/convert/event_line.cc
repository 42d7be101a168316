// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/event_line.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "proto/convert/names.h"

namespace plumescout {
namespace {

template <typename... Case>
struct Cases : Case... {
  using Case::operator()...;
};
template <typename... Case>
Cases(Case...) -> Cases<Case...>;

std::string At(Point2 place) { return absl::StrFormat("(%.2f, %.2f)", place.x_m, place.y_m); }
std::string At(const Pose2& pose) { return At(Point2{pose.x_m, pose.y_m}); }

v1::MissionEventKind KindOfPayload(const Observation& observation) {
  return std::visit(
      Cases{[](const Scan&) { return v1::MISSION_EVENT_KIND_SCAN; },
            [](const GasReading&) { return v1::MISSION_EVENT_KIND_GAS_READING; },
            [](const SequenceGap&) { return v1::MISSION_EVENT_KIND_SEQUENCE_GAP; },
            [](const PoseCorrection&) { return v1::MISSION_EVENT_KIND_POSE_CORRECTION; },
            [](const RobotStatus&) { return v1::MISSION_EVENT_KIND_ROBOT_STATUS; }},
      observation.payload);
}

std::string LineOfObservation(const Observation& observation) {
  const std::string place = At(observation.pose);
  return std::visit(
      Cases{[&](const Scan& scan) {
              return absl::StrCat("scan ", observation.sequence, ", ", scan.ranges_m.size(),
                                  " beams at ", place);
            },
            [&](const GasReading& reading) {
              return absl::StrFormat("gas reading %d, %.6g ppm at %s", observation.sequence,
                                     reading.concentration_ppm, place);
            },
            [](const SequenceGap& gap) {
              return absl::StrCat("observations ", gap.first_sequence, " to ", gap.last_sequence,
                                  " are lost");
            },
            [](const PoseCorrection& correction) {
              return absl::StrCat("corrects its past poses by ", correction.anchors.size(),
                                  " anchors");
            },
            [](const RobotStatus& status) {
              return absl::StrFormat("battery at %.0f %%", 100.0 * status.battery_share);
            }},
      observation.payload);
}

const char* NameOf(GoalKind kind) {
  switch (kind) {
    case GoalKind::kOccupancyFrontier:
      return "an occupancy frontier";
    case GoalKind::kGasFrontier:
      return "a gas frontier";
    case GoalKind::kRandomFreeSpace:
      return "free space";
    case GoalKind::kHome:
      return "home";
    case GoalKind::kInformation:
      return "where readings tell much";
    case GoalKind::kSite:
      return "a site";
    case GoalKind::kMakeWay:
      return "where it is in nobody's way";
  }
  return "a goal";
}

const char* NameOf(PlanEnd end) {
  switch (end) {
    case PlanEnd::kAllGoalsReached:
    case PlanEnd::kQueueExhausted:
    case PlanEnd::kStopped:
      return "none is better than to stay";
    case PlanEnd::kNoGoals:
      return "there are no goals";
    case PlanEnd::kMissionComplete:
      return "the mission is complete";
    case PlanEnd::kStartOccupied:
      return "there is no way out of where the robot stands";
    case PlanEnd::kAllGoalsRejected:
      return "all goals are rejected";
  }
  return "no reason";
}

std::string LineOfPlan(const Plan& plan) {
  if (plan.chosen < 0 || plan.trajectory.waypoints.empty()) {
    return absl::StrCat("plan to stay: ", NameOf(plan.end));
  }
  // A journal keeps the chosen candidate, wherever it stood among the others.
  const auto chosen = static_cast<std::size_t>(plan.chosen);
  const bool is_kept = chosen < plan.candidates.size();
  const std::string goal = is_kept ? absl::StrCat(NameOf(plan.candidates[chosen].goal.kind), " at ",
                                                  At(plan.candidates[chosen].goal.position))
                                   : At(plan.trajectory.waypoints.back().pose);
  return absl::StrFormat("plan to %s, %.1f m in %.1f s", goal, plan.trajectory.length_m,
                         plan.trajectory.duration_s);
}

const char* NameOf(ProgressOutcome outcome) {
  switch (outcome) {
    case ProgressOutcome::kReached:
      return "reached";
    case ProgressOutcome::kBlocked:
      return "blocked";
    case ProgressOutcome::kAborted:
      return "aborted";
  }
  return "ended";
}

std::string LineOfAreas(const KeepOutChanged& change) {
  std::vector<std::string> closed;
  for (const Polygon& area : change.added) closed.push_back(area.name);
  std::vector<std::string> parts;
  if (!change.deleted.empty()) {
    parts.push_back(absl::StrCat(absl::StrJoin(change.deleted, ", "), " opened"));
  }
  if (!closed.empty()) parts.push_back(absl::StrCat(absl::StrJoin(closed, ", "), " closed"));
  return absl::StrCat("keep-out areas: ", absl::StrJoin(parts, "; "));
}

std::string RobotOf(const EventBody& body) {
  return std::visit(Cases{[](const PlanIssued& issued) { return issued.plan.robot; },
                          [](const PosteriorRefreshed&) { return RobotId(); },
                          [](const EpochBegun&) { return RobotId(); },
                          [](const EpochAdopted&) { return RobotId(); },
                          [](const MapRebuildBegun&) { return RobotId(); },
                          [](const MapRebuilt&) { return RobotId(); },
                          [](const KeepOutChanged&) { return RobotId(); },
                          [](const auto& of_robot) { return of_robot.robot; }},
                    body);
}

std::optional<std::int64_t> TimeOf_ns(const EventBody& body) {
  using Time = std::optional<std::int64_t>;
  return std::visit(
      Cases{[](const ObservationReceived& received) {
              return Time(received.observation.sample_time_ns);
            },
            [](const PosteriorRefreshed& refreshed) { return Time(refreshed.time_ns); },
            [](const EpochBegun& begun) { return Time(begun.time_ns); },
            [](const auto&) { return Time(); }},
      body);
}

}  // namespace

v1::MissionEventKind KindOf(const EventBody& body) {
  return std::visit(
      Cases{[](const RobotRegistered&) { return v1::MISSION_EVENT_KIND_ROBOT_REGISTERED; },
            [](const ObservationReceived& received) { return KindOfPayload(received.observation); },
            [](const PosteriorRefreshed&) { return v1::MISSION_EVENT_KIND_REFRESH; },
            [](const PlanIssued&) { return v1::MISSION_EVENT_KIND_PLAN; },
            [](const ProgressReported&) { return v1::MISSION_EVENT_KIND_REPORT; },
            [](const EpochBegun&) { return v1::MISSION_EVENT_KIND_EPOCH_BEGUN; },
            [](const EpochAdopted&) { return v1::MISSION_EVENT_KIND_EPOCH_ADOPTED; },
            [](const RobotRemoved&) { return v1::MISSION_EVENT_KIND_ROBOT_REMOVED; },
            [](const ClockOffsetNoted&) { return v1::MISSION_EVENT_KIND_CLOCK_OFFSET; },
            [](const HomeOrdered&) { return v1::MISSION_EVENT_KIND_HOME_ORDERED; },
            [](const MapRebuildBegun&) { return v1::MISSION_EVENT_KIND_MAP_REBUILD_BEGUN; },
            [](const MapRebuilt&) { return v1::MISSION_EVENT_KIND_MAP_REBUILT; },
            [](const KeepOutChanged&) { return v1::MISSION_EVENT_KIND_KEEP_OUT_CHANGED; }},
      body);
}

std::string LineOf(const EventBody& body) {
  return std::visit(
      Cases{[](const RobotRegistered& registered) {
              return absl::StrFormat("joins with a radius of %.2f m", registered.radius_m);
            },
            [](const ObservationReceived& received) {
              return LineOfObservation(received.observation);
            },
            [](const PosteriorRefreshed&) { return std::string("gas field refreshed"); },
            [](const PlanIssued& issued) {
              return absl::StrCat(issued.assigned ? "assigned " : "", LineOfPlan(issued.plan));
            },
            [](const ProgressReported& report) {
              return absl::StrCat("plan ", report.plan_id, " ", NameOf(report.outcome));
            },
            [](const EpochBegun&) { return std::string("gas field is made anew"); },
            [](const EpochAdopted&) { return std::string("gas field made anew is adopted"); },
            [](const RobotRemoved&) { return std::string("leaves"); },
            [](const ClockOffsetNoted& noted) {
              return absl::StrFormat("the mission's time is its clock and %.3f s",
                                     1e-9 * static_cast<double>(noted.offset_ns));
            },
            [](const HomeOrdered& order) {
              return std::string(order.home ? "is sent home" : "need not go home any more");
            },
            [](const MapRebuildBegun&) {
              return std::string("map begins to be rebuilt with corrected poses");
            },
            [](const MapRebuilt&) {
              return std::string("rebuilt map is adopted, if there is room for it");
            },
            [](const KeepOutChanged& change) { return LineOfAreas(change); }},
      body);
}

v1::MissionEvent ToProto(const Event& event, const MissionId& mission) {
  v1::MissionEvent proto;
  proto.set_number(event.number);
  proto.set_kind(KindOf(event.body));
  const RobotId robot = RobotOf(event.body);
  if (!robot.empty()) proto.set_robot(RobotResource({mission, robot}));
  if (const auto time_ns = TimeOf_ns(event.body)) proto.set_sample_time_ns(*time_ns);
  proto.set_summary(LineOf(event.body));
  return proto;
}

}  // namespace plumescout
