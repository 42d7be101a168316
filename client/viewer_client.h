// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "client/mission_details.h"
#include "client/mission_history.h"
#include "client/robot_details.h"
#include "core/types/gas_at_place.h"
#include "core/types/ids.h"
#include "core/types/map_changes.h"
#include "core/types/map_snapshot.h"
#include "core/types/map_view.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"
#include "core/types/trajectory.h"

namespace plumescout::client {

struct MapQuery {
  MapView view = {};  // at least one layer
  // The posterior brought up to date first; else it may be refresh_period_s of sample time old.
  bool fresh_posterior = false;
  std::int64_t revision = 0;  // the map as it was then, at most the last durable one; 0: as it is
  int max_part_bytes = 0;     // of one message, about; 0: as the server has it
};

struct MapWatchQuery {
  MapView view = {};  // at least one layer
  // Begin with the map as it was at this revision and show what happened since; none: live.
  std::optional<std::int64_t> from_revision = std::nullopt;
  double speed_ratio = 1.0;  // so many times faster than it happened; [0.001, 1e6]
};

// A map that follows the mission's. Not thread-safe, but for Cancel. After any error but
// kDeadlineExceeded it is dead: open another.
class MapWatch {
 public:
  virtual ~MapWatch() = default;

  // Waits for the map's next revision, and says what of its rasters has changed: at first
  // everything. A reader that is slow skips revisions. kDeadlineExceeded if none came (the watch
  // lives on).
  virtual absl::StatusOr<MapChanges> Read(absl::Duration timeout) = 0;
  // As of the last Read, if that was OK; else it may be half on its way to the next revision.
  // Layers that are not watched are unknown, NaN.
  virtual const MapSnapshot& map() const = 0;
  // A Read that waits, and each after it, is kCancelled.
  virtual void Cancel() = 0;
};

struct GasQuery {
  std::vector<Point2> points = {};  // frame map; 1 to 4096
  std::string species = {};         // empty: the first
  bool fresh_posterior = false;     // as in MapQuery
  std::int64_t revision = 0;        // as in MapQuery
  bool with_verdicts = false;       // say how the mission's objective stands there, too
};

struct GasAnswer {
  std::int64_t revision = 0;
  std::int64_t posterior_time_ns = 0;  // sample time that the posterior has reached
  std::vector<GasAtPlace> gas;         // one a point, in their order
  GasQuality quality;
  GasAudits audits;
  std::int64_t sample_time_ns = 0;  // newest that the mission has heard: ages of readings end then
};

struct FrontierList {
  std::int64_t revision = 0;
  std::vector<JudgedFrontier> frontiers;  // those of gas first
};

// A plan that its robot has not ended.
struct LivePlan {
  PlanId plan = 0;
  RobotId robot;
  GoalKind goal_kind = GoalKind::kOccupancyFrontier;
  Point2 goal;
  std::int64_t arrival_time_ns = 0;  // in the mission's time
  Trajectory trajectory;
};

struct PlanList {
  std::int64_t revision = 0;
  std::vector<LivePlan> live;  // by robot
  // What each robot was told last, live or not, with everything it was chosen from, if asked for;
  // none of robots that have had none since the server started.
  std::vector<Plan> latest = {};
};

// What can be seen of missions. It changes nothing, and viewers may call all of it. Errors as of
// OperatorClient. Thread-safe.
class ViewerClient {
 public:
  virtual ~ViewerClient() = default;

  virtual absl::StatusOr<MissionDetails> GetMission(const MissionId& mission) = 0;
  // In order of their names.
  virtual absl::StatusOr<std::vector<MissionDetails>> ListMissions() = 0;

  virtual absl::StatusOr<RobotDetails> GetRobot(const MissionId& mission, const RobotId& robot) = 0;
  // In order of their names.
  virtual absl::StatusOr<std::vector<RobotDetails>> ListRobots(const MissionId& mission) = 0;

  virtual absl::StatusOr<MapSnapshot> GetMap(const MissionId& mission, const MapQuery& query) = 0;
  // Returns at once; errors come from the watch.
  virtual absl::StatusOr<std::unique_ptr<MapWatch>> WatchMap(const MissionId& mission,
                                                             const MapWatchQuery& query) = 0;
  virtual absl::StatusOr<GasAnswer> QueryGas(const MissionId& mission, const GasQuery& query) = 0;

  // Every frontier as a goal of that robot, and why it would not be one now.
  virtual absl::StatusOr<FrontierList> ListFrontiers(const MissionId& mission,
                                                     const RobotId& robot) = 0;
  // `with_latest` is not for callers of role robot.
  virtual absl::StatusOr<PlanList> ListPlans(const MissionId& mission, bool with_latest) = 0;
  // A page of what happened, as far as it is durable. Not for callers of role robot.
  virtual absl::StatusOr<HistoryPage> GetHistory(const MissionId& mission,
                                                 const HistoryQuery& query) = 0;
  // How the map came to have its figures, as far as the server has replayed that; it does so while
  // somebody asks. Not for callers of role robot.
  virtual absl::StatusOr<FigureHistory> GetFigures(const MissionId& mission) = 0;
};

}  // namespace plumescout::client
