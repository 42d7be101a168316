// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/mission_moments.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/lab/sim/small_scene.h"

namespace plumescout::lab {
namespace mission_moments_test {

constexpr double kDuration_s = 15.0;

RecordedMission Record() {
  EpisodeOptions options;
  options.mission = "moments";
  options.create = MissionOptions{};
  options.duration_s = kDuration_s;
  auto mission = RecordMission(SmallWorld(), options, nullptr);
  EXPECT_TRUE(mission.ok()) << mission.status();
  return mission.ok() ? *std::move(mission) : RecordedMission{};
}

const RecordedMission& Mission() {
  static const RecordedMission mission = Record();
  return mission;
}

TEST(MissionMoments, KeepsEveryTrajectoryWithWhatWasBelieved) {
  ASSERT_FALSE(Mission().moments.empty());
  for (const MissionMoment& moment : Mission().moments) {
    ASSERT_NE(moment.belief, nullptr);
    EXPECT_GE(moment.plan.chosen, 0);
    EXPECT_GE(moment.belief->revision, moment.plan.belief_revision);
    EXPECT_LE(moment.time_s, kDuration_s);
  }
  EXPECT_EQ(Mission().map.robots.size(), 1u);
}

TEST(MissionMoments, KeepsTheReadingsAsSent) {
  // Two a second; the ends may or may not count.
  EXPECT_NEAR(static_cast<double>(Mission().readings.size()), 2.0 * kDuration_s, 2.0);
  EXPECT_TRUE(std::is_sorted(
      Mission().readings.begin(), Mission().readings.end(),
      [](const MissionReading& a, const MissionReading& b) { return a.time_s < b.time_s; }));
}

TEST(MissionMoments, SameOptionsSameMission) {
  const RecordedMission again = Record();
  ASSERT_EQ(again.moments.size(), Mission().moments.size());
  EXPECT_TRUE(again.map.gas_mean_ppm.values().size() == Mission().map.gas_mean_ppm.values().size());
  for (std::size_t i = 0; i < again.moments.size(); ++i) {
    EXPECT_EQ(Chosen(again.moments[i]).path, Chosen(Mission().moments[i]).path);
  }
}

TEST(MissionMoments, TheWayEndsAtTheMoment) {
  const double last_s = Mission().moments.back().time_s;
  const auto way = DrivenUntil(Mission(), last_s);
  const auto whole = DrivenUntil(Mission(), kDuration_s + 1.0);
  EXPECT_LE(way.size(), whole.size());
  EXPECT_EQ(whole.size(), Mission().episode.path.size());
  EXPECT_LT(Distance_m(way.back(), Chosen(Mission().moments.back()).path.front()), 0.3);
}

TEST(MissionMoments, PicturesShowTheTrajectoryOnTheField) {
  const MissionMoment& moment = Mission().moments.back();
  const MomentStyle style{RegionOf(SmallWorld().scene().geometry())};
  for (const MapPanel& panel :
       {MomentPanel(Mission(), moment, "mean", style), MomentFieldPanel(moment, "field", style)}) {
    EXPECT_GT(panel.cells.image.width(), 0);
    ASSERT_FALSE(panel.lines.empty());
    EXPECT_EQ(panel.lines.back().points, Chosen(moment).path);
    ASSERT_TRUE(panel.color_bar.has_value());
  }
  EXPECT_EQ(MetricCharts(Mission().episode).size(), 3u);
  EXPECT_EQ(MetricRows(Mission().episode).size(), Mission().episode.samples.size());
}

}  // namespace mission_moments_test
}  // namespace plumescout::lab
