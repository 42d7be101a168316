// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/draw/robot_drawing.h"

#include <variant>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "proto/convert/foxglove.h"
#include "proto/convert/observation.h"
#include "proto/convert/plan.h"

namespace plumescout {
namespace {

constexpr std::int64_t kPosePeriod_ns = 200'000'000;
constexpr std::int64_t kScanPeriod_ns = 1'000'000'000;

std::string TopicOf(const RobotId& robot, absl::string_view what) {
  return absl::StrCat("/robots/", robot, "/", what);
}

std::string WayOf(const RobotId& robot) { return absl::StrCat("plans/", robot); }

}  // namespace

bool IsDue(std::int64_t time_ns, std::int64_t period_ns, std::optional<std::int64_t>& shown_ns) {
  if (shown_ns && time_ns >= *shown_ns && time_ns - *shown_ns < period_ns) return false;
  shown_ns = time_ns;
  return true;
}

absl::Status RobotDrawing::DrawPose(const RobotId& robot, const Pose2& pose, McapTimes times) {
  if (!IsDue(times.publish_ns, kPosePeriod_ns, shown_[robot].pose_ns)) return absl::OkStatus();
  return channels_.Add(TopicOf(robot, "pose"), FoxglovePose(pose, times.publish_ns), times);
}

absl::Status RobotDrawing::DrawObservation(const RobotId& robot, const RobotFrame& frame,
                                           const Observation& observation, McapTimes times) {
  const Pose2 pose = InMission(frame, observation.pose);
  PLUMESCOUT_RETURN_IF_ERROR(DrawPose(robot, pose, times));
  if (std::holds_alternative<GasReading>(observation.payload)) {
    return channels_.Add(TopicOf(robot, "gas"), ToProto(observation), times);
  }
  const auto* scan = std::get_if<Scan>(&observation.payload);
  if (scan == nullptr || !IsDue(times.publish_ns, kScanPeriod_ns, shown_[robot].scan_ns)) {
    return absl::OkStatus();
  }
  return channels_.Add(TopicOf(robot, "scan"), FoxgloveScan(*scan, pose, times.publish_ns), times);
}

absl::Status RobotDrawing::DrawPlan(const MissionId& mission, const Plan& plan, McapTimes times) {
  PLUMESCOUT_RETURN_IF_ERROR(channels_.Add("/plans", ToProto(plan, mission), times));
  if (plan.trajectory.waypoints.empty()) return DrawEndOfPlan(plan.robot, times);
  return channels_.Add("/scene/plans",
                       FoxgloveWay(WayOf(plan.robot), plan.trajectory, times.log_ns), times);
}

absl::Status RobotDrawing::DrawEndOfPlan(const RobotId& robot, McapTimes times) {
  return channels_.Add("/scene/plans", FoxgloveGone(WayOf(robot), times.log_ns), times);
}

absl::Status RobotDrawing::DrawLine(bool is_warning, absl::string_view name, absl::string_view line,
                                    McapTimes times) {
  const auto level = is_warning ? foxglove::Log::WARNING : foxglove::Log::INFO;
  return channels_.Add("/log", FoxgloveLog(level, name, line, times.log_ns), times);
}

}  // namespace plumescout
