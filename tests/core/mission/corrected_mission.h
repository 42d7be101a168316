// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "core/mission/conduct/mission_conduct.h"
#include "core/mission/mission.h"
#include "gtest/gtest.h"
#include "tests/support/box_room.h"

namespace plumescout::support {

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;
inline constexpr double kWall_m = 0.05;  // walls stand in the middle of cells, not between two

inline Scan RoomFrom(const Pose2& pose) {
  return ScanInBox({pose.x_m - kWall_m, pose.y_m - kWall_m, pose.yaw_rad}, 7.1, 5.1);
}

class CorrectionsRecorder final : public ConductObserver {
 public:
  void OnEvent(const Event& event, const Applied& applied) override {
    events.push_back(event.body);
    suspicions += applied.turned_suspect ? 1 : 0;
    if (!applied.map.ok()) kept_maps.push_back(applied.map);
  }
  std::vector<absl::Status> kept_maps;
  std::vector<EventBody> events;
  int suspicions = 0;
};

// Robot "a" drives a circle in a room, in steps of 0.1 s, and holds itself to be where Told says.
class CorrectedMission : public ::testing::Test {
 protected:
  explicit CorrectedMission(const MissionOptions& options = {}) : options_(options) {
    conduct_ = std::make_unique<MissionConduct>(*Mission::Create(options), &recorder_);
    EXPECT_TRUE(conduct_->Register(RobotRegistered{"a", 0.2, 1}).ok());
  }

  Pose2 TruthAt(int step) const {
    const double angle_rad = 0.02 * step;
    return {3.5 + 1.5 * std::cos(angle_rad), 2.5 + 1.2 * std::sin(angle_rad), angle_rad};
  }
  absl::Status Send(std::int64_t time_ns, const Pose2& pose, ObservationPayload payload) {
    std::vector<IncomingObservation> batch(1);
    batch[0].observation = {++sequence_, time_ns, pose, std::move(payload)};
    IngestResult result = conduct_->Ingest("a", 1, std::move(batch));
    EXPECT_TRUE(result.status.ok()) << result.status;
    return result.refused.empty() ? absl::OkStatus() : result.refused[0].status;
  }
  static std::int64_t TimeOf(int step) { return kSecond_ns + step * kSecond_ns / 10; }
  void Drive(int steps, const Pose2& frame = {}) {
    for (int i = 0; i < steps; ++i, ++step_) {
      const Pose2 truth = TruthAt(step_);
      const Pose2 told = frame == Pose2{} ? truth : Compose(frame, truth);
      EXPECT_TRUE(Send(TimeOf(step_), told, RoomFrom(truth)).ok());
      if (step_ % 5 == 0) {
        EXPECT_TRUE(Send(TimeOf(step_), told, GasReading{10.0 * truth.x_m, 0.0}).ok());
      }
    }
  }
  RobotState State() const { return conduct_->Snapshot()->robots.at("a").state; }
  int Occupied() const {
    const auto belief = conduct_->Snapshot();
    return static_cast<int>(std::count(belief->occupancy->values().begin(),
                                       belief->occupancy->values().end(), CellState::kOccupied));
  }
  std::vector<EventBody> Rebuilds() const {
    std::vector<EventBody> rebuilds;
    for (const EventBody& body : recorder_.events) {
      if (std::holds_alternative<MapRebuilt>(body)) rebuilds.push_back(body);
    }
    return rebuilds;
  }
  // A correction by which its way lies so far off where it was.
  PoseCorrection Shift(double by_m) const {
    const Pose2 now = TruthAt(step_ - 1);
    return {{{TimeOf(step_ - 1), {now.x_m + by_m, now.y_m, now.yaw_rad}}}};
  }
  absl::Status Correct(const PoseCorrection& correction) {
    const PoseAnchor last = correction.anchors.back();
    return Send(last.sample_time_ns, last.pose, correction);
  }
  // The correction of a way that jumped at that step.
  PoseCorrection Back(int jumped) const {
    PoseCorrection correction;
    for (const int step : {jumped - 1, jumped, step_ - 1}) {
      correction.anchors.push_back({TimeOf(step), TruthAt(step)});
    }
    return correction;
  }
  void ExpectReplays() const {
    const auto replay = *Mission::Create(options_);
    for (const EventBody& body : recorder_.events) ASSERT_TRUE(replay->Apply(body).ok());
    EXPECT_EQ(replay->Digest(), conduct_->mission().Digest());
  }

  const MissionOptions options_;
  CorrectionsRecorder recorder_;
  std::unique_ptr<MissionConduct> conduct_;
  std::int64_t sequence_ = 0;
  int step_ = 0;
};

// About the robot, which was at the step's place.
inline Pose2 JumpAbout(const Pose2& place, double dx_m, double dy_m, double dyaw_rad) {
  const Pose2 after{place.x_m + dx_m, place.y_m + dy_m, place.yaw_rad + dyaw_rad};
  return Compose(after, Inverse(place));
}

}  // namespace plumescout::support
