// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "client/ingest_session.h"
#include "client/join.h"
#include "client/planner_client.h"
#include "core/types/grid.h"
#include "core/types/trajectory.h"

namespace plumescout::lab {

struct LoadRobotOptions {
  client::Participation participation;
  Pose2 start;
  double scan_hz = 10.0;
  int scans_per_gas_reading = 5;
  absl::Duration plan_period = absl::Seconds(1);  // 0: never plans
  absl::Duration plan_offset;                     // of the first plan: robots do not ask in step
};

struct LoadRobotFigures {
  std::vector<double> plan_wall_ms;
  std::int64_t plan_failures = 0;
  client::IngestStatistics ingest;
};

// A robot that loads a server as a real one does, in real time: scans and gas readings at their
// rates, a plan every second, and it drives along its latest plan.
class LoadRobot {
  struct Private {
    explicit Private() = default;
  };

 public:
  LoadRobot(Private, std::unique_ptr<client::PlannerClient> client, const Grid<std::uint8_t>& walls,
            const LoadRobotOptions& options, client::RobotSession session);
  // Joins the mission and begins. `walls` must outlive the robot.
  static absl::StatusOr<std::unique_ptr<LoadRobot>> Start(
      std::unique_ptr<client::PlannerClient> client, const Grid<std::uint8_t>& walls,
      const LoadRobotOptions& options);
  ~LoadRobot();

  // When the observation was taken; nothing for numbers not given yet.
  std::optional<absl::Time> TakenAt(std::int64_t sequence) const;
  client::IngestStatistics ingest_statistics() const { return ingest_.statistics(); }
  // The plans since the last such call, and where the log stands.
  LoadRobotFigures Take();
  // Stops and waits until what was sent is applied, or until `drain` has gone by.
  LoadRobotFigures Stop(absl::Duration drain);

 private:
  struct Leg {
    Trajectory trajectory;
    absl::Time departure;
  };

  void RunSensors();
  void RunPlanner();
  void Observe(std::int64_t tick);
  void Plan();
  Pose2 PoseNow() const;

  const LoadRobotOptions options_;
  const Grid<std::uint8_t>& walls_;
  const std::unique_ptr<client::PlannerClient> client_;

  mutable absl::Mutex mutex_;
  Leg leg_ ABSL_GUARDED_BY(mutex_);
  std::vector<absl::Time> taken_at_ ABSL_GUARDED_BY(mutex_);  // of observation index + 1
  LoadRobotFigures figures_ ABSL_GUARDED_BY(mutex_);

  client::IngestSession ingest_;
  std::atomic<bool> stopping_ = false;
  std::thread sensors_;
  std::thread planner_;
};

}  // namespace plumescout::lab
