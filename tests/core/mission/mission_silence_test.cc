// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Missions whose robots die, leave and come back.
#include <cmath>
#include <memory>
#include <vector>

#include "core/mission/mission.h"
#include "gtest/gtest.h"
#include "tests/support/box_room.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace mission_silence_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kWidth_m = 6.0;
constexpr double kHeight_m = 4.0;

// Robot "b" reaches the east wall of a room and says nothing more; robot "a" goes on scanning it.
class Watch {
 public:
  explicit Watch(const MissionOptions& options = {}) : mission_(Mission::Create(options).value()) {
    Apply(RobotRegistered{"a", 0.2, 1});
    Apply(RobotRegistered{"b", 0.2, 2});
    const Pose2 at_wall{kWidth_m - 0.1, kHeight_m / 2, 0.0};
    Apply(ObservationReceived{"b", {1, kSecond_ns, at_wall, GasReading{1.0}}});
  }

  void Scan(int scans) {
    const Pose2 pose{1.0, kHeight_m / 2, 0.0};
    for (int k = 0; k < scans; ++k) {
      ++scans_;
      Apply(ObservationReceived{"a",
                                {scans_, (1 + scans_) * kSecond_ns, pose,
                                 support::ScanInBox(pose, kWidth_m, kHeight_m)}});
    }
  }
  void Apply(EventBody body) {
    const auto applied = mission_->Apply(body);
    ASSERT_TRUE(applied.ok()) << applied.status();
    log_.push_back(std::move(body));
  }
  // Of the east wall near "b", how much is not known to be wall.
  double HoleInWall_m() const {
    const Grid<CellState>& map = *mission_->Snapshot()->occupancy;
    double hole_m = 0.0;
    for (double y_m = kHeight_m / 2 - 0.45; y_m < kHeight_m / 2 + 0.5; y_m += 0.1) {
      const Cell cell = map.geometry().CellAt({kWidth_m + 0.01, y_m});
      const bool wall = map.At(cell, CellState::kUnknown) == CellState::kOccupied ||
                        map.At({cell.x - 1, cell.y}, CellState::kUnknown) == CellState::kOccupied;
      if (!wall) hole_m += 0.1;
    }
    return hole_m;
  }
  Mission& mission() { return *mission_; }
  const std::vector<EventBody>& log() const { return log_; }

 private:
  std::unique_ptr<Mission> mission_;
  std::vector<EventBody> log_;
  std::int64_t scans_ = 0;
};

TEST(MissionSilenceTest, TheMaskOfARobotThatDiedExpires) {
  Watch watch;
  watch.Scan(50);
  EXPECT_GT(watch.HoleInWall_m(), 0.3) << "it may still stand there";
  watch.Scan(150);
  EXPECT_EQ(watch.HoleInWall_m(), 0.0);
  EXPECT_TRUE(watch.mission().Snapshot()->robots.at("b").state.silent);
}

TEST(MissionSilenceTest, AnOptionSaysHowLongToWait) {
  MissionOptions options;
  options.robot_silence_s = 1000.0;
  Watch watch(options);
  watch.Scan(200);
  EXPECT_GT(watch.HoleInWall_m(), 0.3);
}

TEST(MissionSilenceTest, ARobotThatWasRemovedMasksNothing) {
  Watch watch;
  watch.Apply(RobotRemoved{"b"});
  watch.Scan(20);
  EXPECT_EQ(watch.HoleInWall_m(), 0.0);
  EXPECT_EQ(watch.mission().Snapshot()->robots.count("b"), 0u);
  EXPECT_EQ(watch.mission().Apply(RobotRemoved{"b"}).status().code(), absl::StatusCode::kNotFound);
}

TEST(MissionSilenceTest, ReplayGivesTheSameBytes) {
  Watch watch;
  Plan plan;
  plan.robot = "b";
  watch.Apply(PlanIssued{plan});
  watch.Scan(70);
  watch.Apply(PosteriorRefreshed{71 * kSecond_ns});
  watch.Apply(RobotRemoved{"b"});
  watch.Apply(RobotRegistered{"b", 0.3, 3});
  watch.Apply(ObservationReceived{"b", {2, 72 * kSecond_ns, {2.0, 1.0, 0.0}, GasReading{1.0}}});
  watch.Scan(10);
  const auto replay = Mission::Create({}).value();
  for (const EventBody& body : watch.log()) ASSERT_TRUE(replay->Apply(body).ok());
  const auto a = watch.mission().Snapshot();
  const auto b = replay->Snapshot();
  EXPECT_EQ(a->revision, b->revision);
  EXPECT_EQ(a->phase, b->phase);
  EXPECT_TRUE(support::SameBytes(*a->occupancy, *b->occupancy));
  EXPECT_TRUE(support::SameBytes(*a->gas_variance_ppm2, *b->gas_variance_ppm2));
  ASSERT_EQ(a->robots.size(), b->robots.size());
  for (const auto& [id, record] : a->robots) EXPECT_EQ(record.state, b->robots.at(id).state);
}

}  // namespace mission_silence_test
}  // namespace plumescout
