// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/map_relay.h"

#include <gtest/gtest.h>

#include <vector>

#include "absl/synchronization/notification.h"

namespace plumescout::client {
namespace map_relay_test {

// Shows `revisions` maps, then breaks or, if it is the last, waits for its cancellation.
class ShortWatch final : public MapWatch {
 public:
  ShortWatch(int revisions, bool is_last) : left_(revisions), is_last_(is_last) {}

  absl::StatusOr<MapChanges> Read(absl::Duration) override {
    if (left_-- > 0) {
      ++map_.revision;
      return MapChanges{};
    }
    if (!is_last_) return absl::UnavailableError("the link is down");
    cancelled_.WaitForNotification();
    return absl::CancelledError("cancelled");
  }
  const MapSnapshot& map() const override { return map_; }
  void Cancel() override { cancelled_.Notify(); }

 private:
  int left_;
  const bool is_last_;
  MapSnapshot map_;
  absl::Notification cancelled_;
};

class WatchesOnly final : public ViewerClient {
 public:
  absl::StatusOr<std::unique_ptr<MapWatch>> WatchMap(const MissionId& mission,
                                                     const MapWatchQuery& query) override {
    EXPECT_EQ(mission, "hall");
    EXPECT_TRUE(query.view.occupancy && query.view.gas_mean && query.view.gas_variance);
    const int number = watches_++;
    if (number == 0) return absl::NotFoundError("no such mission yet");
    return std::make_unique<ShortWatch>(2, /*is_last=*/number == 2);
  }
  absl::StatusOr<MissionDetails> GetMission(const MissionId&) override { return No(); }
  absl::StatusOr<std::vector<MissionDetails>> ListMissions() override { return No(); }
  absl::StatusOr<RobotDetails> GetRobot(const MissionId&, const RobotId&) override { return No(); }
  absl::StatusOr<std::vector<RobotDetails>> ListRobots(const MissionId&) override { return No(); }
  absl::StatusOr<MapSnapshot> GetMap(const MissionId&, const MapQuery&) override { return No(); }
  absl::StatusOr<GasAnswer> QueryGas(const MissionId&, const GasQuery&) override { return No(); }
  absl::StatusOr<FrontierList> ListFrontiers(const MissionId&, const RobotId&) override {
    return No();
  }
  absl::StatusOr<PlanList> ListPlans(const MissionId&, bool) override { return No(); }
  absl::StatusOr<HistoryPage> GetHistory(const MissionId&, const HistoryQuery&) override {
    return No();
  }
  absl::StatusOr<FigureHistory> GetFigures(const MissionId&) override { return No(); }

 private:
  static absl::Status No() { return absl::UnimplementedError("nobody asks"); }

  int watches_ = 0;
};

TEST(MapRelay, OpensAgainWhatBreaksAndEndsWhileItWaits) {
  WatchesOnly client;
  std::vector<std::int64_t> revisions;
  std::vector<absl::StatusCode> broken;
  absl::Notification all;
  {
    const MapRelay relay(
        client,
        {.mission = "hall",
         .period = absl::ZeroDuration(),
         .backoff = {.initial = absl::Milliseconds(1)}},
        {.on_map =
             [&](const MapSnapshot& map) {
               revisions.push_back(map.revision);
               if (revisions.size() == 4) all.Notify();
             },
         .on_broken = [&](const absl::Status& status) { broken.push_back(status.code()); }});
    ASSERT_TRUE(all.WaitForNotificationWithTimeout(absl::Seconds(60)));
  }
  EXPECT_EQ(revisions, (std::vector<std::int64_t>{1, 2, 1, 2}));
  EXPECT_EQ(broken, (std::vector{absl::StatusCode::kNotFound, absl::StatusCode::kUnavailable}));
}

}  // namespace map_relay_test
}  // namespace plumescout::client
