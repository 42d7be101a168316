// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "client/planner_client.h"

namespace plumescout::lab {

enum class LinkState {
  kUp,
  kDown,  // calls are kUnavailable, streams die, watches tell nothing
  kGone,  // the same, but the robot is switched off: it is not told that its last report is lost
};

// What lies between one robot and a planning service: a link that can be cut. A watch outlives
// that, and tells afterwards what is news by then. Thread-safe; streams and watches must not
// outlive it.
class FaultyLink final : public client::PlannerClient {
 public:
  // `service` must outlive the link, which is up.
  explicit FaultyLink(client::PlannerClient& service) : service_(service) {}

  void Set(LinkState state);
  LinkState state() const { return state_; }

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

 private:
  class Stream;
  class Watch;

  absl::Status Check() const;

  client::PlannerClient& service_;
  std::atomic<LinkState> state_ = LinkState::kUp;
  std::atomic<int> cuts_ = 0;  // streams from before one are dead
};

}  // namespace plumescout::lab
