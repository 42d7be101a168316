// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "client/planner_client.h"
#include "lab/local/local_mission.h"

namespace plumescout::lab {

// The planning service within one process: missions of the core, without protobuf or gRPC, under
// the rules of the wire. Runs of robots that act one at a time are repeatable if plans have a
// budget of infinite time. Thread-safe; streams must not outlive the client.
class LocalPlannerClient final : public client::PlannerClient {
 public:
  explicit LocalPlannerClient(const LocalOptions& options = {}) : options_(options) {}

  absl::Status CreateMission(const MissionId& mission, const MissionOptions& options) override;
  absl::StatusOr<std::vector<MissionId>> ListMissions() override;
  absl::Status DeleteMission(const MissionId& mission) override;
  using PlannerClient::RegisterRobot;
  absl::StatusOr<client::RobotSession> RegisterRobot(const MissionId& mission, const RobotId& robot,
                                                     double radius_m, bool take_over,
                                                     std::int64_t log_epoch,
                                                     const client::RobotOutfit& outfit) override;
  absl::Status RemoveRobot(const MissionId& mission, const RobotId& robot, std::int64_t lease_token,
                           bool force) override;
  absl::StatusOr<std::unique_ptr<client::ObservationStream>> OpenObservationStream(
      const client::RobotSession& session) override;
  absl::StatusOr<Plan> NextBestTrajectory(const MissionId& mission,
                                          const client::PlanQuery& query) override;
  absl::Status ReportProgress(const client::RobotSession& session, PlanId plan,
                              ProgressOutcome outcome) override;
  absl::StatusOr<std::unique_ptr<client::RobotWatch>> WatchRobot(
      const client::RobotSession& session) override;
  absl::StatusOr<MapSnapshot> GetMap(const MissionId& mission) override;

  // PlanningService.PlanTeam. Robots fetch what was assigned with NextBestTrajectory.
  absl::StatusOr<CommittedTeam> PlanTeam(const MissionId& mission, const TeamRequest& request,
                                         absl::Duration budget);

  // What studies compare with the truth, without the copies that GetMap makes.
  absl::StatusOr<std::shared_ptr<const Belief>> GetBelief(const MissionId& mission) const;

 private:
  absl::StatusOr<std::shared_ptr<LocalMission>> Find(const MissionId& mission) const;

  const LocalOptions options_;
  mutable absl::Mutex mutex_;
  std::map<MissionId, std::shared_ptr<LocalMission>> missions_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::lab
