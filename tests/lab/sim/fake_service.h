// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "tests/client/fake_planner_client.h"

namespace plumescout::lab {

// Passes everything on to the fake server but GetMap: a map that tells what is applied, and of
// which there is no more unless `draw` fills it in from what was received.
class FakeService final : public client::PlannerClient {
 public:
  explicit FakeService(RobotId robot) : robot_(std::move(robot)) {}

  client::FakePlannerClient& server() { return server_; }
  void set_draw(std::function<void(const std::vector<Observation>&, MapSnapshot&)> draw) {
    draw_ = std::move(draw);
  }
  void FailMaps(absl::Status status, int times) {
    failure_ = std::move(status);
    failures_left_ = times;
  }

  absl::Status CreateMission(const MissionId& mission, const MissionOptions& options) override {
    return server_.CreateMission(mission, options);
  }
  absl::StatusOr<std::vector<MissionId>> ListMissions() override { return server_.ListMissions(); }
  absl::Status DeleteMission(const MissionId& mission) override {
    return server_.DeleteMission(mission);
  }
  using PlannerClient::RegisterRobot;
  absl::StatusOr<client::RobotSession> RegisterRobot(const MissionId& mission, const RobotId& robot,
                                                     double radius_m, bool take_over,
                                                     std::int64_t log_epoch,
                                                     const client::RobotOutfit& outfit) override {
    return server_.RegisterRobot(mission, robot, radius_m, take_over, log_epoch, outfit);
  }
  absl::Status RemoveRobot(const MissionId& mission, const RobotId& robot, std::int64_t lease_token,
                           bool force) override {
    return server_.RemoveRobot(mission, robot, lease_token, force);
  }
  absl::StatusOr<std::unique_ptr<client::ObservationStream>> OpenObservationStream(
      const client::RobotSession& session) override {
    return server_.OpenObservationStream(session);
  }
  absl::StatusOr<Plan> NextBestTrajectory(const MissionId& mission,
                                          const client::PlanQuery& query) override {
    return server_.NextBestTrajectory(mission, query);
  }
  absl::Status ReportProgress(const client::RobotSession& session, PlanId plan,
                              ProgressOutcome outcome) override {
    return server_.ReportProgress(session, plan, outcome);
  }
  absl::StatusOr<MapSnapshot> GetMap(const MissionId&) override {
    if (failures_left_ > 0) {
      --failures_left_;
      return failure_;
    }
    MapSnapshot map;
    map.revision = server_.applied();
    map.robots.push_back({.id = robot_, .pose = {}, .applied_sequence = map.revision});
    if (draw_) draw_(server_.received(), map);
    return map;
  }

 private:
  RobotId robot_;
  client::FakePlannerClient server_;
  std::function<void(const std::vector<Observation>&, MapSnapshot&)> draw_;
  absl::Status failure_;
  int failures_left_ = 0;
};

}  // namespace plumescout::lab
