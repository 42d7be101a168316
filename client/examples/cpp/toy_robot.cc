// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// toy_robot HOST:PORT MISSION: a robot that maps a room of 6 x 4 m with a leak in a corner. Its
// world and its time are made up, so the mission is over in seconds. A robot that drives itself by
// velocities has most of this done for it by client/robot_loop.h.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "client/grpc_planner_client.h"
#include "client/ingest_session.h"
#include "core/types/trajectory.h"

namespace {

using plumescout::Pose2;
namespace client = plumescout::client;

constexpr double kWidth_m = 6.0;
constexpr double kHeight_m = 4.0;
constexpr double kTick_s = 0.2;
constexpr std::int64_t kTick_ns = 200'000'000;
constexpr int kLooks = 5;
constexpr int kBeams = 180;
constexpr int kMostPlans = 30;

// What a beam meets of the walls of the room.
double RangeAt(const Pose2& pose, double bearing_rad) {
  const double dx = std::cos(pose.yaw_rad + bearing_rad);
  const double dy = std::sin(pose.yaw_rad + bearing_rad);
  const double to_x = ((dx > 0 ? kWidth_m : 0.0) - pose.x_m) / dx;
  const double to_y = ((dy > 0 ? kHeight_m : 0.0) - pose.y_m) / dy;
  return std::min(dx != 0.0 ? to_x : HUGE_VAL, dy != 0.0 ? to_y : HUGE_VAL);
}

// What the robot sees and smells there.
void Sense(client::IngestSession& log, const Pose2& pose, std::int64_t time_ns) {
  plumescout::Scan scan{.angle_step_rad = 2.0 * M_PI / kBeams, .max_range_m = 3.0};
  for (int i = 0; i < kBeams; ++i) {
    const double range_m = RangeAt(pose, i * scan.angle_step_rad);
    const bool hit = range_m < scan.max_range_m;  // infinite: nothing is there
    scan.ranges_m.push_back(hit ? static_cast<float>(range_m)
                                : std::numeric_limits<float>::infinity());
  }
  const double from_leak_m = plumescout::Distance_m(pose.position(), {5.0, 3.0});
  log.Append(time_ns, pose, scan);
  log.Append(time_ns, pose,
             plumescout::GasReading{.concentration_ppm = 20.0 * std::exp(-from_leak_m)});
}

absl::Status Run(client::PlannerClient& planner, const plumescout::MissionId& mission) {
  const absl::Status created = planner.CreateMission(mission, {});
  if (!created.ok() && !absl::IsAlreadyExists(created)) return created;
  const auto join = [&] { return planner.RegisterRobot(mission, "toy", 0.2, /*take_over=*/true); };
  const auto joined = join();
  if (!joined.ok()) return joined.status();
  client::IngestSession log(planner, *joined, {.rejoin = join}, {});

  Pose2 pose{1.0, 1.0, 0.0};
  std::int64_t time_ns = 1'000'000'000'000'000'000;
  // One look is not enough for a cell to be free.
  for (int i = 0; i < kLooks; ++i) Sense(log, pose, time_ns += kTick_ns);
  for (int count = 0; count < kMostPlans; ++count) {
    // Plans are made on what the server holds: wait until that is all.
    const std::int64_t told = log.statistics().last_sequence;
    if (const absl::Status status = log.WaitApplied(told, absl::Seconds(30)); !status.ok()) {
      return status;
    }
    const auto plan = planner.NextBestTrajectory(mission, {.request = {.robot = "toy"},
                                                           .lease_token = log.session().lease_token,
                                                           .min_applied_sequence = told});
    if (!plan.ok()) return plan.status();
    std::printf("%s\n", plan->explanation.c_str());
    if (plan->trajectory.waypoints.empty()) break;  // nothing is left to do
    for (double t = kTick_s; t < plan->trajectory.duration_s + kTick_s; t += kTick_s) {
      pose = plumescout::PoseAt(plan->trajectory, t);
      Sense(log, pose, time_ns += kTick_ns);
    }
    const absl::Status reported =
        planner.ReportProgress(log.session(), plan->id, plumescout::ProgressOutcome::kReached);
    if (!reported.ok()) return reported;
  }
  return planner.RemoveRobot(mission, "toy", log.session().lease_token, /*force=*/false);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: toy_robot HOST:PORT MISSION\n");
    return EXIT_FAILURE;
  }
  const auto planner = client::MakeGrpcPlannerClient({.target = argv[1]});
  const absl::Status status = Run(*planner, argv[2]);
  if (!status.ok()) std::fprintf(stderr, "toy_robot: %s\n", status.ToString().c_str());
  return status.ok() ? EXIT_SUCCESS : EXIT_FAILURE;
}
