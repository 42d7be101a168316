// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load/load_robot.h"

#include <utility>

#include "absl/time/clock.h"
#include "client/path_follower.h"
#include "core/types/status_macros.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

// A plume in the south-west corner, so that there is something to find.
constexpr double kPlumePeak_ppm = 50.0;
constexpr double kPlumeScale_m = 4.0;

double Concentration_ppm(Point2 at) {
  const double share = Distance_m(at, {0.0, 0.0}) / kPlumeScale_m;
  return kPlumePeak_ppm * std::exp(-share * share);
}

}  // namespace

absl::StatusOr<std::unique_ptr<LoadRobot>> LoadRobot::Start(
    std::unique_ptr<client::PlannerClient> client, const Grid<std::uint8_t>& walls,
    const LoadRobotOptions& options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(client::RobotSession session,
                              client::Join(*client, options.participation));
  return std::make_unique<LoadRobot>(Private(), std::move(client), walls, options,
                                     std::move(session));
}

LoadRobot::LoadRobot(Private, std::unique_ptr<client::PlannerClient> client,
                     const Grid<std::uint8_t>& walls, const LoadRobotOptions& options,
                     client::RobotSession session)
    : options_(options),
      walls_(walls),
      client_(std::move(client)),
      leg_{.trajectory = {.waypoints = {{.pose = options.start}}}, .departure = absl::Now()},
      ingest_(*client_, std::move(session),
              {.rejoin = [this] { return client::Join(*client_, options_.participation); },
               .on_rejected = nullptr,
               .on_link = nullptr},
              {}),
      sensors_([this] { RunSensors(); }),
      planner_([this] { RunPlanner(); }) {}

LoadRobot::~LoadRobot() { Stop(absl::ZeroDuration()); }

std::optional<absl::Time> LoadRobot::TakenAt(std::int64_t sequence) const {
  absl::MutexLock lock(&mutex_);
  if (sequence < 1 || sequence > static_cast<std::int64_t>(taken_at_.size())) return std::nullopt;
  return taken_at_[static_cast<std::size_t>(sequence - 1)];
}

LoadRobotFigures LoadRobot::Take() {
  absl::MutexLock lock(&mutex_);
  LoadRobotFigures taken = std::exchange(figures_, {});
  taken.ingest = ingest_.statistics();
  return taken;
}

LoadRobotFigures LoadRobot::Stop(absl::Duration drain) {
  stopping_ = true;
  if (sensors_.joinable()) sensors_.join();
  if (planner_.joinable()) planner_.join();
  // What is missing after the time shows in the statistics.
  ingest_.WaitApplied(ingest_.statistics().last_sequence, drain).IgnoreError();
  absl::MutexLock lock(&mutex_);
  figures_.ingest = ingest_.statistics();
  return figures_;
}

void LoadRobot::RunSensors() {
  const absl::Time start = absl::Now();
  for (std::int64_t tick = 0; !stopping_; ++tick) {
    absl::SleepFor(start + absl::Seconds(static_cast<double>(tick) / options_.scan_hz) -
                   absl::Now());
    Observe(tick);
  }
}

void LoadRobot::Observe(std::int64_t tick) {
  const Pose2 pose = PoseNow();
  const Scan scan = ScanBuilding(walls_, pose);
  const bool gas_due = tick % options_.scans_per_gas_reading == 0;
  const absl::Time now = absl::Now();
  absl::MutexLock lock(&mutex_);  // numbers and times stay in step
  ingest_.Append(absl::ToUnixNanos(now), pose, scan);
  taken_at_.push_back(now);
  if (!gas_due) return;
  ingest_.Append(absl::ToUnixNanos(now), pose,
                 GasReading{.concentration_ppm = Concentration_ppm(pose.position())});
  taken_at_.push_back(now);
}

void LoadRobot::RunPlanner() {
  if (options_.plan_period <= absl::ZeroDuration()) return;
  absl::Time due = absl::Now() + options_.plan_offset + options_.plan_period;
  while (!stopping_) {
    absl::SleepFor(due - absl::Now());
    due += options_.plan_period;
    if (!stopping_) Plan();
  }
}

void LoadRobot::Plan() {
  const client::RobotSession session = ingest_.session();
  client::PlanQuery query;
  query.request.robot = session.robot;
  query.request.start = PoseNow();
  query.lease_token = session.lease_token;
  query.min_applied_sequence = ingest_.statistics().last_sequence;
  const absl::Time asked = absl::Now();
  const auto plan = client_->NextBestTrajectory(session.mission, query);
  const absl::Time answered = absl::Now();
  absl::MutexLock lock(&mutex_);
  if (!plan.ok()) {
    ++figures_.plan_failures;
    return;
  }
  figures_.plan_wall_ms.push_back(absl::ToDoubleMilliseconds(answered - asked));
  if (!plan->trajectory.waypoints.empty()) leg_ = {plan->trajectory, answered};
}

Pose2 LoadRobot::PoseNow() const {
  absl::MutexLock lock(&mutex_);
  return PoseAt(leg_.trajectory, absl::ToDoubleSeconds(absl::Now() - leg_.departure));
}

}  // namespace plumescout::lab
