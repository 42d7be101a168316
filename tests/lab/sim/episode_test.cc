// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/episode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "tests/lab/sim/fake_service.h"
#include "tests/lab/sim/small_scene.h"

namespace plumescout::lab {
namespace episode_test {

// One metre west and back, at 1 m/s.
Plan ThereAndBack(const client::PlanQuery& query) {
  const Pose2 start = query.request.start.value();
  Plan plan;
  plan.id = 1;
  plan.trajectory.waypoints = {
      {start, 0.0, 0.0}, {{start.x_m - 1.0, start.y_m, 0.0}, 1.0, 0.0}, {start, 2.0, 0.0}};
  plan.trajectory.length_m = 2.0;
  plan.trajectory.duration_s = 2.0;
  return plan;
}

EpisodeOptions ShortEpisode() {
  EpisodeOptions options;
  options.mission = "study";
  options.create = MissionOptions{};
  options.duration_s = 12.0;
  options.metrics_period_s = 2.0;
  return options;
}

TEST(EpisodeTest, RunsUntilTheTimeIsUp) {
  FakeService service("robot-1");
  service.server().set_script(ThereAndBack);
  const auto result = RunEpisode(service, SmallWorld(), ShortEpisode());
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_FALSE(result->completed);
  EXPECT_NEAR(result->simulated_s, 12.0, 0.1 + 1e-6);  // one tick
  EXPECT_GE(result->plans.size(), 4u);                 // each leg takes 2 s, and a little to ask
  EXPECT_EQ(result->collisions, 0);
  EXPECT_GT(result->distance_m, 8.0);
}

TEST(EpisodeTest, EndsWhenThePlannerSaysSo) {
  FakeService service("robot-1");  // says so at once
  const auto result = RunEpisode(service, SmallWorld(), ShortEpisode());
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_TRUE(result->completed);
  EXPECT_EQ(result->plans.size(), 1u);
  EXPECT_LT(result->simulated_s, 2.0);
}

TEST(EpisodeTest, JudgesTheMapEveryPeriodAndAtTheEnd) {
  FakeService service("robot-1");
  service.server().set_script(ThereAndBack);
  EpisodeOptions options = ShortEpisode();
  int told = 0;
  options.on_sample = [&](const MetricSample& sample, const MapSnapshot& map) {
    ++told;
    EXPECT_EQ(sample.revision, map.revision);
  };
  const auto result = RunEpisode(service, SmallWorld(), options);
  ASSERT_TRUE(result.ok()) << result.status();
  ASSERT_GE(result->samples.size(), 7u);  // 0, 2, ... 10, and the end
  EXPECT_EQ(told, static_cast<int>(result->samples.size()));
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(result->samples[i].time_s, 2.0 * static_cast<double>(i), 0.1 + 1e-6);
  }
  EXPECT_EQ(result->samples.back().time_s, result->simulated_s);
  EXPECT_EQ(result->samples.back().revision, result->readings_applied);
}

TEST(EpisodeTest, SendsEveryReading) {
  FakeService service("robot-1");
  service.server().set_script(ThereAndBack);
  const auto result = RunEpisode(service, SmallWorld(), ShortEpisode());
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->readings_sent, result->readings_applied);
  // 10 scans and 2 gas readings a second; the ends may or may not count.
  EXPECT_NEAR(static_cast<double>(result->readings_sent), 12.0 * 12.0, 4.0);
}

TEST(EpisodeTest, IsRepeatableInLockstep) {
  const auto run = [] {
    FakeService service("robot-1");
    service.server().set_script(ThereAndBack);
    auto result = RunEpisode(service, SmallWorld(), ShortEpisode());
    EXPECT_TRUE(result.ok()) << result.status();
    std::vector<std::int64_t> revisions;
    for (const MetricSample& sample : result->samples) revisions.push_back(sample.revision);
    std::vector<Pose2> path;
    for (const DrivenPose& driven : result->path) path.push_back(driven.pose);
    return std::tuple(revisions, path, service.server().received());
  };
  EXPECT_TRUE(run() == run());
}

TEST(EpisodeTest, SteersIfTold) {
  FakeService service("robot-1");
  service.server().set_script(ThereAndBack);
  EpisodeOptions options = ShortEpisode();
  options.following = client::Following::kProportional;
  const auto result = RunEpisode(service, SmallWorld(), options);
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_GT(result->distance_m, 1.0);
}

TEST(EpisodeTest, StopsWhenTold) {
  FakeService service("robot-1");
  service.server().set_script(ThereAndBack);
  int asked = 0;
  const auto result =
      RunEpisode(service, SmallWorld(), ShortEpisode(), [&] { return ++asked > 20; });
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_FALSE(result->completed);
  EXPECT_LT(result->simulated_s, 11.0);
}

TEST(EpisodeTest, FailsWithoutMaps) {
  FakeService service("robot-1");
  service.server().set_script(ThereAndBack);
  service.FailMaps(absl::InternalError("no maps today"), 1);
  EXPECT_EQ(RunEpisode(service, SmallWorld(), ShortEpisode()).status().message(), "no maps today");
}

TEST(EpisodeTest, WaitsForTheMapOfAServerThatComesBack) {
  FakeService service("robot-1");
  service.server().set_script(ThereAndBack);
  service.FailMaps(absl::UnavailableError("going down"), 3);
  EXPECT_TRUE(RunEpisode(service, SmallWorld(), ShortEpisode()).ok());
}

TEST(EpisodeTest, RejectsOptionsOutOfRange) {
  FakeService service("robot-1");
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EpisodeOptions options = ShortEpisode();
    options.duration_s = bad;
    EXPECT_TRUE(absl::IsInvalidArgument(RunEpisode(service, SmallWorld(), options).status()));
    options = ShortEpisode();
    options.metrics_period_s = bad;
    EXPECT_TRUE(absl::IsInvalidArgument(RunEpisode(service, SmallWorld(), options).status()));
    options = ShortEpisode();
    options.prior_variance_ppm2 = bad;
    EXPECT_TRUE(absl::IsInvalidArgument(RunEpisode(service, SmallWorld(), options).status()));
  }
}

TEST(EpisodeTest, RejectsAStopTooShortForTheSensor) {
  FakeService service("robot-1");
  EpisodeOptions options = ShortEpisode();
  options.gas_settling_s = 5.0;
  options.create->planning.dwell_s = 5.0;
  const absl::Status status = RunEpisode(service, SmallWorld(), options).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status));
  EXPECT_NE(status.message().find("gas_settling_s = 5"), absl::string_view::npos) << status;
}

TEST(EpisodeTest, RejectsRobotsOfOneName) {
  FakeService service("robot-1");
  const absl::Status status =
      RunTeamEpisode(service, SmallWorld(), ShortEpisode(), {{"robot-1", {3.0, 0.5, 0.0}, 2}})
          .status();
  EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
  EXPECT_NE(status.message().find("\"robot-1\""), absl::string_view::npos) << status;
}

TEST(EpisodeTest, RejectsATeammateThatStartsInAWall) {
  FakeService service("robot-1");
  const absl::Status status =
      RunTeamEpisode(service, SmallWorld(), ShortEpisode(), {{"robot-2", {2.0, 1.5, 0.0}, 2}})
          .status();
  EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
}

}  // namespace episode_test
}  // namespace plumescout::lab
