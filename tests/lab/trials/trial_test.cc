// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/trial.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/plan/strategy.h"
#include "tests/lab/sim/small_scene.h"

namespace plumescout::lab {
namespace trial_test {

MissionOptions MissionBy(const char* strategy) {
  MissionOptions mission;
  mission.planning.strategy = strategy;
  EXPECT_TRUE(ApplyStrategyRow(mission.planning).ok());
  return mission;
}

Trial SmallTrial(const MissionOptions& mission, const SceneWorld& world) {
  Trial trial;
  trial.mission = &mission;
  trial.world = &world;
  trial.duration_s = 12.0;
  trial.map_times_s = {5.0, 10.0};
  return trial;
}

TEST(Trial, RecordsMetricsMapsAndReadings) {
  const SceneWorld world(SmallScene());
  const MissionOptions mission = MissionBy("xit_gff");
  const auto record = RunTrial(SmallTrial(mission, world));
  ASSERT_TRUE(record.ok()) << record.status();
  ASSERT_EQ(record->curve.size(), 4u);  // 0, 5, 10 s and the end
  EXPECT_LT(record->curve.back().metrics.rmse_ppm, record->curve.front().metrics.rmse_ppm);
  EXPECT_GT(record->curve.back().metrics.completeness, 0.9);
  EXPECT_NEAR(record->calibration.rmse_ppm, record->curve.back().metrics.rmse_ppm, 0.01);
  EXPECT_GT(record->calibration.estimated_cells, 0);
  EXPECT_LE(record->calibration.estimated_cells, record->curve.back().metrics.critical_cells);
  EXPECT_GT(record->calibration.within_2_sigma, record->calibration.within_1_sigma);
  EXPECT_GT(record->calibration.rms_z, 0.0);
  EXPECT_EQ(record->gas_readings, 24);  // 2 Hz
  ASSERT_EQ(record->mean_ppm.size(), 2u);
  EXPECT_EQ(record->mean_ppm[0].geometry(), world.scene().geometry());
  EXPECT_TRUE(std::isnan(record->mean_ppm[0][Cell{0, 0}]));  // in the wall
  EXPECT_GT(record->distance_m, 5.0);
  EXPECT_GT(record->plans, 0);
}

TEST(Trial, IsTheSameAgainAndAnotherWithAnotherSeed) {
  const SceneWorld world(SmallScene());
  for (const char* strategy : {"xit_gff", "rrt_star_frontier"}) {
    const MissionOptions mission = MissionBy(strategy);
    Trial trial = SmallTrial(mission, world);
    const auto once = RunTrial(trial);
    const auto again = RunTrial(trial);
    trial.seed = 2;
    const auto other = RunTrial(trial);
    ASSERT_TRUE(once.ok() && again.ok() && other.ok());
    EXPECT_EQ(once->curve.back().metrics.rmse_ppm, again->curve.back().metrics.rmse_ppm);
    EXPECT_EQ(once->distance_m, again->distance_m);
    EXPECT_NE(once->curve.back().metrics.rmse_ppm, other->curve.back().metrics.rmse_ppm);
  }
}

// There are always readings that would tell a little more: here some six minutes of them.
TEST(Trial, OfPlumescoutEndsOfItself) {
  const SceneWorld world(SmallScene());
  const MissionOptions mission = MissionBy("plumescout");
  Trial trial = SmallTrial(mission, world);
  trial.duration_s = 600.0;
  for (trial.seed = 1; trial.seed <= 3; ++trial.seed) {
    const auto record = RunTrial(trial);
    ASSERT_TRUE(record.ok()) << record.status();
    EXPECT_TRUE(record->completed);
    EXPECT_GT(record->curve.back().metrics.completeness, 0.95);
  }
}

TEST(Trial, AMissionThatIsInvalidIsAnError) {
  const SceneWorld world(SmallScene());
  MissionOptions mission = MissionBy("xit_gff");
  mission.gas.prior_precision_per_ppm2 = -1.0;
  EXPECT_EQ(RunTrial(SmallTrial(mission, world)).status().code(),
            absl::StatusCode::kInvalidArgument);
}

TEST(Trial, MapsTheSameReadingsByAPeer) {
  const SceneWorld world(SmallScene());
  const MissionOptions mission = MissionBy("xit_gff");
  Trial trial = SmallTrial(mission, world);
  EXPECT_FALSE(RunTrial(trial)->peer_rmse_ppm.has_value());
  trial.peer = KernelDmvOptions{};
  const auto record = RunTrial(trial);
  ASSERT_TRUE(record.ok() && record->peer_rmse_ppm.has_value());
  EXPECT_GT(*record->peer_rmse_ppm, 0.0);
  EXPECT_LT(*record->peer_rmse_ppm, record->curve.back().metrics.rmse_zero_ppm);
  trial.peer->kernel_width_m = -1.0;
  EXPECT_TRUE(absl::IsInvalidArgument(RunTrial(trial).status()));
}

TEST(Trial, RobotsMayBeOtherThanOurs) {
  const SceneWorld world(SmallScene());
  const MissionOptions mission = MissionBy("xit_gff");
  Trial trial = SmallTrial(mission, world);
  const auto ours = RunTrial(trial);
  trial.robot.lidar_range_m = 1.0;
  const auto short_sighted = RunTrial(trial);
  trial.robot = {.plan_latency_s = 3.0};
  const auto slow = RunTrial(trial);
  trial.robot = {.corrects_gas_lag = false};
  const auto raw = RunTrial(trial);
  ASSERT_TRUE(ours.ok() && short_sighted.ok() && slow.ok() && raw.ok());
  EXPECT_LT(short_sighted->curve[1].metrics.completeness, ours->curve[1].metrics.completeness);
  EXPECT_LE(slow->plans, 4);  // one every three seconds
  EXPECT_GT(ours->plans, slow->plans);
  EXPECT_NE(raw->curve.back().metrics.rmse_ppm, ours->curve.back().metrics.rmse_ppm);
}

TEST(Trial, MayEndWhenNoFrontierIsLeft) {
  const SceneWorld world(SmallScene());
  MissionOptions mission = MissionBy("rrt_star_frontier");
  mission.planning.fallback_to_unobserved = false;
  Trial trial = SmallTrial(mission, world);
  trial.duration_s = 100.0;
  trial.map_times_s = {5.0, 99.0};
  trial.robot.stops_without_frontier = true;
  const auto record = RunTrial(trial);
  ASSERT_TRUE(record.ok()) << record.status();
  EXPECT_LT(record->curve.back().time_s, 90.0);
  EXPECT_GT(record->curve.back().metrics.completeness, 0.9);
  EXPECT_EQ(record->mean_ppm.size(), 2u) << "the second is of the end";
}

TEST(Trial, TellsOtherEntropiesOfTheSameReadings) {
  const SceneWorld world(SmallScene());
  const MissionOptions mission = MissionBy("xit_gff");
  Trial trial = SmallTrial(mission, world);
  EXPECT_FALSE(RunTrial(trial)->other_entropies.has_value());
  trial.tells_other_entropies = true;
  const auto record = RunTrial(trial);
  ASSERT_TRUE(record.ok() && record->other_entropies.has_value());
  EXPECT_LT(record->other_entropies->propagated_nats, record->curve.back().metrics.entropy_nats);
}

TEST(Trial, MapsTheSameReadingsInASecondField) {
  const SceneWorld world(SmallScene());
  MissionOptions mission = MissionBy("xit_gff");
  Trial trial = SmallTrial(mission, world);
  EXPECT_FALSE(RunTrial(trial)->second_field.has_value());
  trial.second_field = mission.gas;
  const auto same = RunTrial(trial);
  ASSERT_TRUE(same.ok() && same->second_field.has_value()) << same.status();
  const MapMetrics& own = same->curve.back().metrics;
  EXPECT_NEAR(same->second_field->rmse_ppm, own.rmse_ppm, 1e-3 * own.rmse_ppm);
  EXPECT_NEAR(same->second_field->entropy_nats, own.entropy_nats, 1e-3 * own.critical_cells);
  EXPECT_EQ(same->second_field->completeness, own.completeness);
  trial.second_field = PublishedGasOptions();
  const auto other = RunTrial(trial);
  ASSERT_TRUE(other.ok()) << other.status();
  EXPECT_EQ(other->curve.back().metrics.rmse_ppm, own.rmse_ppm) << "it is mapped alone";
  EXPECT_GT(std::abs(other->second_field->entropy_nats - own.entropy_nats),
            1e-2 * own.critical_cells);
}

TEST(Trial, RobotsMayLeaveTheLagToTheMission) {
  const SceneWorld world(SmallScene());
  MissionOptions mission = MissionBy("xit_gff");
  Trial trial = SmallTrial(mission, world);
  const auto undone = RunTrial(trial);
  trial.robot.leaves_lag_to_mission = true;
  trial.second_field = mission.gas;
  const auto left = RunTrial(trial);
  ASSERT_TRUE(undone.ok() && left.ok()) << left.status();
  EXPECT_NE(left->curve.back().metrics.rmse_ppm, undone->curve.back().metrics.rmse_ppm);
  EXPECT_NE(left->second_field->rmse_ppm, left->curve.back().metrics.rmse_ppm)
      << "there each reading is at one place";
}

TEST(Trial, TeamsShareTheMission) {
  const SceneWorld world(SmallScene());
  const MissionOptions mission = MissionBy("plumescout");
  Trial trial = SmallTrial(mission, world);
  const auto alone = RunTrial(trial);
  trial.robots = 2;
  const auto team = RunTrial(trial);
  ASSERT_TRUE(alone.ok() && team.ok()) << team.status();
  EXPECT_EQ(team->gas_readings, 2 * alone->gas_readings);
  EXPECT_NEAR(team->team.robot_s, 24.0, 0.5);
  EXPECT_EQ(alone->team.closest_m, std::nullopt);
  EXPECT_GE(team->team.closest_m, 0.4) << "bodies of 0.2 m block each other";
  EXPECT_LE(team->team.closest_m, 0.75) << "they start nearly so near";
  EXPECT_GE(team->team.legs, 2);
  EXPECT_LE(team->team.blocked_legs, team->team.legs);
  EXPECT_GT(team->team.plan_wall_s, 0.0);
  EXPECT_EQ(alone->team.findings, TeamFindings{});
  const TeamFindings& findings = team->team.findings;
  EXPECT_LE(findings.blocked_by_robot, team->team.blocked_legs);
  EXPECT_GT(findings.alone_nats, 0.0);
  EXPECT_GT(findings.besides_nats, 0.0);
  EXPECT_LE(findings.besides_nats, findings.alone_nats * (1.0 + 1e-3));
}

TEST(Trial, GhostsAreNotInEachOthersWay) {
  const SceneWorld world(SmallScene());
  MissionOptions mission = MissionBy("plumescout");
  mission.planning.yield_to_robots = false;
  Trial trial = SmallTrial(mission, world);
  trial.robots = 3;
  trial.ghosts = true;
  const auto ghosts = RunTrial(trial);
  trial.ghosts = false;
  const auto bodies = RunTrial(trial);
  ASSERT_TRUE(ghosts.ok() && bodies.ok()) << ghosts.status() << bodies.status();
  EXPECT_EQ(ghosts->team.contacts, 0);
  EXPECT_EQ(ghosts->team.findings.blocked_by_robot, 0);
  EXPECT_EQ(ghosts->team.closest_m, std::nullopt);
  EXPECT_GE(bodies->team.closest_m, 0.4);
  EXPECT_NE(bodies->distance_m, ghosts->distance_m) << "bodies are seen, and stood in the way";
}

TEST(Trial, FollowersMayBeLate) {
  const SceneWorld world(SmallScene());
  const MissionOptions mission = MissionBy("xit_gff");
  Trial trial = SmallTrial(mission, world);
  const auto prompt = RunTrial(trial);
  trial.most_late_s = 1.0;
  const auto late = RunTrial(trial);
  ASSERT_TRUE(prompt.ok() && late.ok());
  EXPECT_NE(prompt->curve.back().metrics.rmse_ppm, late->curve.back().metrics.rmse_ppm);
}

}  // namespace trial_test
}  // namespace plumescout::lab
