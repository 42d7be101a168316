// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "core/types/event.h"
#include "core/types/gas_sensor.h"
#include "core/types/map_snapshot.h"
#include "core/types/observation.h"
#include "core/types/options.h"
#include "core/types/plan.h"
#include "core/types/plan_request.h"
#include "core/types/robot_frame.h"
#include "core/types/robot_notice.h"
#include "core/types/trajectory_verdict.h"

namespace plumescout::client {

// What the server holds of a robot's log.
struct IngestState {
  std::int64_t applied_sequence = 0;  // in the mission's state
  std::int64_t durable_sequence = 0;  // survives a crash of the server: the robot may forget it
  std::int64_t credit_sequence = 0;   // last number the robot may send now
  std::int64_t revision = 0;          // mission revision that includes applied_sequence

  friend bool operator==(const IngestState&, const IngestState&) = default;
};

// What a robot tells of itself when it registers.
struct RobotOutfit {
  RobotFrame frame = {};                // of the poses of its observations
  std::vector<GasSensor> sensors = {};  // see RobotRegistered

  friend bool operator==(const RobotOutfit&, const RobotOutfit&) = default;
};

// A robot's standing in a mission, from RegisterRobot.
struct RobotSession {
  MissionId mission;
  RobotId robot;
  std::int64_t lease_token = 0;
  std::string server_boot_id;  // changes when the server restarts
  IngestState ingest;
  // Whether numbers up to ingest.applied_sequence are of this client's log. If not, its first
  // observation takes the number after that.
  bool log_continues = true;
  // Up to which number this client was ever told that the log is durable: what it opens streams
  // with. 0: it was not told.
  std::int64_t durable_sequence = 0;
  // The robot's clock now, from any thread: batches say when they were sent by it, so that the
  // server learns how far it is off. Null: they do not, and its sample times are taken as they are.
  std::function<std::int64_t()> robot_clock_ns = nullptr;
};

struct ObservationRejected {
  std::int64_t sequence = 0;
  absl::Status status;
};

using IngestReply = std::variant<IngestState, ObservationRejected>;

// What became of a batch that was sent by itself.
struct BatchReply {
  IngestState state;
  std::vector<ObservationRejected> rejected = {};
};

// One open ingest stream. Not thread-safe. After any error it is dead: open another.
class ObservationStream {
 public:
  virtual ~ObservationStream() = default;

  // State at opening: send opened().applied_sequence + 1 next.
  virtual const IngestState& opened() const = 0;
  // Of the server that answers. One that restarted with its data serves the leases it gave before.
  virtual std::string server_boot_id() const = 0;
  // Hands over consecutive observations, in order, within the credit.
  virtual absl::Status Write(const std::vector<Observation>& batch) = 0;
  // The next acknowledgement or rejection. kDeadlineExceeded if none came (the stream lives on).
  virtual absl::StatusOr<IngestReply> Read(absl::Duration timeout) = 0;
  // Half-closes and waits for the server's final status.
  virtual absl::Status Finish() = 0;
};

// What the service tells a robot without having been asked. Not thread-safe, but for Cancel. After
// any error but kDeadlineExceeded it is dead: open another.
class RobotWatch {
 public:
  virtual ~RobotWatch() = default;

  // The next notice; kDeadlineExceeded if none came (the watch lives on). The first is a
  // RobotStanding.
  virtual absl::StatusOr<RobotNotice> Read(absl::Duration timeout) = 0;
  // What is there by now.
  absl::StatusOr<RobotNotice> TryRead() { return Read(absl::ZeroDuration()); }
  // A Read that waits, and each after it, is kCancelled.
  virtual void Cancel() = 0;
};

struct PlanQuery {
  PlanRequest request = {};
  std::int64_t lease_token = 0;
  std::int64_t min_applied_sequence =
      0;  // wait until this much of the robot's log is in the belief
  absl::Duration budget = absl::Seconds(1);    // for planning; 0: the server's default
  absl::Duration timeout = absl::Seconds(10);  // of the whole call
};

// Plans that get better until the last, which is the robot's. Not thread-safe, but for Cancel.
// After any error but kDeadlineExceeded it is dead.
class PlanStream {
 public:
  virtual ~PlanStream() = default;

  // The next plan; none after the last. Only the last is committed and has an id.
  // kDeadlineExceeded if none came (the stream lives on).
  virtual absl::StatusOr<std::optional<Plan>> Read(absl::Duration timeout) = 0;
  // A Read that waits, and each after it, is kCancelled. Nothing is committed if it comes in time.
  virtual void Cancel() = 0;
};

// A path that a robot means to drive.
struct IntendedPath {
  std::vector<Point2> vertices;  // frame map, from where the robot is, or will be; 1 to 4096
  GoalKind goal_kind = GoalKind::kOccupancyFrontier;  // what waits at its end
};

struct TrajectoryQuery {
  // The robot's latest plan, the rest of it; or a path, whole.
  std::variant<PlanId, IntendedPath> subject;
  std::int64_t min_applied_sequence = 0;  // as in PlanQuery
};

struct TrajectoryCheck {
  std::int64_t revision = 0;  // of the mission that was looked at
  TrajectoryVerdict verdict;
};

// The planning service as robots and studies see it. The same interface is served over gRPC
// (grpc_planner_client.h) and within one process (lab/local/), so callers and tests run on either.
// What only some services offer is kUnimplemented by default. Thread-safe.
class PlannerClient {
 public:
  virtual ~PlannerClient() = default;

  // Options that equal those of MissionOptions{} are left to the server's configuration.
  // kAlreadyExists if the name is taken.
  virtual absl::Status CreateMission(const MissionId& mission, const MissionOptions& options) = 0;
  virtual absl::StatusOr<std::vector<MissionId>> ListMissions() = 0;
  virtual absl::Status DeleteMission(const MissionId& mission) = 0;

  // Joins a mission or comes back to it. `take_over` supersedes a lease that is still held.
  // `log_epoch`: which log it will send, see RobotRegistered.
  virtual absl::StatusOr<RobotSession> RegisterRobot(const MissionId& mission, const RobotId& robot,
                                                     double radius_m, bool take_over,
                                                     std::int64_t log_epoch,
                                                     const RobotOutfit& outfit) = 0;
  // The same in the mission's frame, with one calibrated sensor.
  absl::StatusOr<RobotSession> RegisterRobot(const MissionId& mission, const RobotId& robot,
                                             double radius_m, bool take_over,
                                             std::int64_t log_epoch) {
    return RegisterRobot(mission, robot, radius_m, take_over, log_epoch, RobotOutfit());
  }
  // And without saying which log.
  absl::StatusOr<RobotSession> RegisterRobot(const MissionId& mission, const RobotId& robot,
                                             double radius_m, bool take_over) {
    return RegisterRobot(mission, robot, radius_m, take_over, /*log_epoch=*/0);
  }
  // The robot leaves: it masks no beam, claims no goal, keeps no mission from completing. Only its
  // newest lease may have it so, or anybody by `force`, for a robot that died. Its log goes on
  // should it register again. kNotFound (ROBOT_NOT_FOUND), LEASE_SUPERSEDED.
  virtual absl::Status RemoveRobot(const MissionId& mission, const RobotId& robot,
                                   std::int64_t lease_token, bool force) = 0;
  // STORE_ROLLED_BACK if the server holds less than session.durable_sequence; see RolledBackTo.
  virtual absl::StatusOr<std::unique_ptr<ObservationStream>> OpenObservationStream(
      const RobotSession& session) = 0;
  virtual absl::StatusOr<Plan> NextBestTrajectory(const MissionId& mission,
                                                  const PlanQuery& query) = 0;
  virtual absl::Status ReportProgress(const RobotSession& session, PlanId plan,
                                      ProgressOutcome outcome) = 0;
  // Returns at once; errors come from the watch, LEASE_SUPERSEDED among them. kUnimplemented: the
  // service tells nothing unasked.
  virtual absl::StatusOr<std::unique_ptr<RobotWatch>> WatchRobot(const RobotSession&) {
    return absl::UnimplementedError("robots are not watched here");
  }
  // Another client may register the robot at once.
  virtual absl::Status ReleaseLease(const RobotSession&) {
    return absl::UnimplementedError("leases are not released here");
  }
  // A batch without a stream, for back-fill: consecutive, within the credit. It may be sent again.
  virtual absl::StatusOr<BatchReply> IngestBatch(const RobotSession&,
                                                 const std::vector<Observation>&) {
    return absl::UnimplementedError("observations come by streams here");
  }
  // As NextBestTrajectory, with what is found on the way. Returns at once; errors come from the
  // stream, which ends after query.timeout at the latest.
  virtual absl::StatusOr<std::unique_ptr<PlanStream>> StreamNextBestTrajectory(const MissionId&,
                                                                               const PlanQuery&) {
    return absl::UnimplementedError("plans do not come in a stream here");
  }
  // Whether a way still holds, on the present map. Operators ask with a session without a lease.
  virtual absl::StatusOr<TrajectoryCheck> CheckTrajectory(const RobotSession&,
                                                          const TrajectoryQuery&) {
    return absl::UnimplementedError("trajectories are not checked here");
  }
  // Of all gases, with the posterior brought up to date.
  virtual absl::StatusOr<MapSnapshot> GetMap(const MissionId& mission) = 0;
};

}  // namespace plumescout::client
