// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "absl/time/time.h"
#include "client/mission_details.h"
#include "client/planner_client.h"
#include "core/types/event.h"
#include "core/types/ids.h"
#include "core/types/plan.h"
#include "core/types/polygon.h"

namespace plumescout::client {

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

// How a mission is kept. What has no value stays as it is.
struct MissionUpdate {
  // A mission that nobody calls for so long is deleted; infinite: never.
  std::optional<absl::Duration> idle_time_to_live = std::nullopt;
  std::optional<EventRetention> event_retention = std::nullopt;
};

// A part of a mission's file, which comes in order and without gaps.
struct MissionFilePiece {
  absl::string_view bytes;
  std::int64_t offset_bytes = 0;    // of the file before it
  std::int64_t expected_bytes = 0;  // about how long the file will be; for who shows progress
};
// Takes the pieces of an export. An error ends it.
using MissionFileSink = std::function<absl::Status(const MissionFilePiece&)>;
// Gives at least one and at most so many of the next bytes of a file; none at its end. An error
// ends the import, which then has changed nothing.
using MissionFileSource = std::function<absl::StatusOr<std::string>(std::size_t max_bytes)>;

// What the file of a mission is to be.
enum class MissionFileFormat {
  kJournal,  // its events, which ImportMission takes
  kMcap,     // an MCAP file, which Foxglove shows
};

// What an export gave.
struct ExportedMission {
  std::int64_t revision = 0;  // last event in the file
  std::int64_t size_bytes = 0;
};

// What operators do to missions; no lease is needed for it. Errors: kNotFound (MISSION_NOT_FOUND,
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
  virtual absl::Status UpdateMission(const MissionId& mission, const MissionUpdate& update) = 0;
  // Closes areas to robots and opens them again, all or none; all areas as they are then. Reasons:
  // KEEP_OUT_AREA_NOT_FOUND, KEEP_OUT_AREA_EXISTS, KEEP_OUT_COVERS_HOME, LIMIT_REACHED.
  virtual absl::StatusOr<std::vector<Polygon>> ChangeKeepOutAreas(const MissionId& mission,
                                                                  const KeepOutChanged& change) = 0;

  // The mission as a file, with its events up to the last one that is durable now. What the sink
  // got is the file only if this is OK: its sums were compared, kDataLoss if they differ. Takes as
  // long as it takes, and one piece of memory.
  virtual absl::StatusOr<ExportedMission> ExportMission(const MissionId& mission,
                                                        MissionFileFormat format,
                                                        const MissionFileSink& sink) = 0;
  // Makes a mission of such a file, a journal, under this name or, if it is empty, that in the
  // file; returns its name once it is durable. MISSION_EXISTS, EXPORT_DAMAGED. Time and memory as
  // of an export.
  virtual absl::StatusOr<MissionId> ImportMission(const MissionId& mission,
                                                  const MissionFileSource& source) = 0;

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
