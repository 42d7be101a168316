// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "client/planner_client.h"
#include "core/types/ids.h"
#include "core/types/map_snapshot.h"
#include "core/types/plan.h"

namespace plumescout::client {

// How a robot is linked to the server.
enum class RobotLink {
  kStreaming,  // its ingest stream is open
  kIdle,       // no stream is open; a client holds its lease
  kSilent,     // its mission has not heard of it while others were heard
  kGone,       // nobody holds its lease
  kUnknown,    // the server says what this client does not know
};

// How far a robot has come on its live plan.
struct PlanProgress {
  PlanId plan = 0;
  double progress_s = 0.0;           // of its trajectory
  double lateness_s = 0.0;           // behind its times
  std::int64_t arrival_time_ns = 0;  // in the mission's time

  friend bool operator==(const PlanProgress&, const PlanProgress&) = default;
};

// A robot as its operator sees it.
struct RobotDetails {
  RobotState state;
  RobotLink link = RobotLink::kGone;
  bool leased = false;  // a client holds its lease
  // RobotState::clock_offset_ns; none if its clock is taken as it is, and the state then has 0.
  std::optional<std::int64_t> clock_offset_ns = std::nullopt;
  // Since its latest batch was applied; none before the first.
  std::optional<double> last_heard_age_s = std::nullopt;
  // Age of the newest sample of that; none unless its batches say when they were sent.
  std::optional<double> ingest_lag_s = std::nullopt;
  std::optional<PlanProgress> live_plan = std::nullopt;  // none, too, if it is to stay
  bool battery_low = false;                              // it is sent home for that
};

// Which robots to plan for at once, and how.
struct TeamQuery {
  std::vector<RobotId> robots = {};  // none: all that are free; live plans of others are replaced
  bool go_home = false;
  std::uint64_t seed = 0;   // 0: derived from the mission's
  int max_order_count = 0;  // orders of the robots to try; 0: as many as the server sees fit
  std::int64_t max_edge_evaluations = 0;       // of each search, for repeatable plans; 0: any
  absl::Duration budget = absl::Seconds(1);    // of all robots together; 0: the server's default
  absl::Duration timeout = absl::Seconds(10);  // of the whole call
};

struct RobotLeftOut {
  RobotId robot;
  std::string why;

  friend bool operator==(const RobotLeftOut&, const RobotLeftOut&) = default;
};

// What robots were given, which they fetch with NextBestTrajectory.
struct TeamPlans {
  std::vector<Plan> plans;  // each keeps clear of those before it
  std::vector<RobotLeftOut> left_out;
  int order_count = 0;  // that were tried to the end
};

// What operators ask of a server; no lease is needed for it. Errors: kNotFound (MISSION_NOT_FOUND,
// ROBOT_NOT_FOUND), kPermissionDenied, MISSION_FINISHED; kInternal if an answer cannot be read.
// Thread-safe.
class OperatorClient {
 public:
  virtual ~OperatorClient() = default;

  // No new plans until the mission is resumed; observations are taken as before.
  virtual absl::Status PauseMission(const MissionId& mission) = 0;
  virtual absl::Status ResumeMission(const MissionId& mission) = 0;
  // Closes it for good: it can be read, nothing changes it any more.
  virtual absl::Status FinishMission(const MissionId& mission) = 0;

  virtual absl::StatusOr<RobotDetails> GetRobot(const MissionId& mission, const RobotId& robot) = 0;
  // In order of their names.
  virtual absl::StatusOr<std::vector<RobotDetails>> ListRobots(const MissionId& mission) = 0;
  // Whoever holds its lease, as of a robot or a client that died. See PlannerClient::RemoveRobot.
  virtual absl::Status RemoveRobot(const MissionId& mission, const RobotId& robot) = 0;
  // Another client may register the robot at once.
  virtual absl::Status ReleaseLease(const MissionId& mission, const RobotId& robot) = 0;
  // One robot, or all that the mission has now; `home` false: they need not go any more.
  virtual absl::Status OrderHome(const MissionId& mission, const std::optional<RobotId>& robot,
                                 bool home) = 0;
  // MISSION_PAUSED.
  virtual absl::StatusOr<TeamPlans> PlanTeam(const MissionId& mission, const TeamQuery& query) = 0;
  // Returns at once; errors come from the watch.
  virtual absl::StatusOr<std::unique_ptr<RobotWatch>> WatchRobot(const MissionId& mission,
                                                                 const RobotId& robot) = 0;
};

}  // namespace plumescout::client
