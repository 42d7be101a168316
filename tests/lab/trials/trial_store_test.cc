// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/trial_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "formats/file_io.h"
#include "tests/lab/sim/small_scene.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace trial_store_test {

using ::testing::MatchesRegex;

constexpr GridGeometry kGeometry{0.0, 0.0, 0.1, 3, 2};

TrialRecord SomeRecord() {
  TrialRecord record;
  record.curve.push_back({0.0, {0.0, std::nan(""), 40.0, std::nan(""), 7}});
  record.curve.push_back({5.0, {0.1 + 0.2, 12.5, 40.0, -3.25, 7}});
  record.mean_ppm.emplace_back(kGeometry, 1.5F);
  record.mean_ppm[0][0] = std::numeric_limits<float>::quiet_NaN();
  record.calibration = {1.5, 0.5, 0.25, std::nan(""), 0.1 + 0.2, 0.9, 1.25, 70};
  record.gas_readings = 11;
  record.distance_m = 1.0 / 3.0;
  record.plans = 4;
  record.collisions = 1;
  record.team = {.legs = 9, .blocked_legs = 2, .contacts = 3, .encounters = 4, .closest_m = 0.41};
  record.team.findings = {.blocked_by_robot = 1,
                          .set_aside_for_robot = 2,
                          .deadlocks = 3,
                          .held_up = 4,
                          .alone_nats = 5.5,
                          .besides_nats = 4.5,
                          .paid_nats = 3.5,
                          .paid_twice_nats = 0.5,
                          .unseen_goals = 9,
                          .unseen_in_others_sight = 2,
                          .unseen_paid_nats = 60.5,
                          .unseen_paid_twice_nats = 20.25};
  record.other_entropies = {-2.5, 1.25};
  record.second_field = MapMetrics{0.5, 3.5, 40.0, -1.5, 7};
  record.completed = true;
  return record;
}

TEST(TrialStore, GivesBackWhatItKept) {
  const TempFolder folder;
  const auto store = TrialStore::Open(folder.File("trials"));
  ASSERT_TRUE(store.ok());
  const TrialRecord kept = SomeRecord();
  ASSERT_TRUE(store->Keep("a-1", "print", kept).ok());
  const auto found = store->Find("a-1", "print", kGeometry);
  ASSERT_TRUE(found.has_value());
  ASSERT_EQ(found->curve.size(), 2u);
  EXPECT_TRUE(std::isnan(found->curve[0].metrics.rmse_ppm));
  EXPECT_EQ(found->curve[1].metrics.completeness, 0.1 + 0.2);
  EXPECT_EQ(found->curve[1].metrics.entropy_nats, -3.25);
  EXPECT_EQ(found->curve[1].metrics.critical_cells, 7);
  EXPECT_TRUE(std::isnan(found->calibration.nlpd_nats));
  EXPECT_EQ(found->calibration.within_1_sigma, 0.1 + 0.2);
  EXPECT_EQ(found->calibration.rms_z, 1.25);
  EXPECT_EQ(found->calibration.estimated_cells, 70);
  EXPECT_EQ(found->distance_m, kept.distance_m);
  EXPECT_EQ(found->gas_readings, 11);
  EXPECT_EQ(found->plans, 4);
  EXPECT_EQ(found->collisions, 1);
  EXPECT_EQ(found->team.legs, 9);
  EXPECT_EQ(found->team.blocked_legs, 2);
  EXPECT_EQ(found->team.contacts, 3);
  EXPECT_EQ(found->team.encounters, 4);
  EXPECT_EQ(found->team.closest_m, 0.41);
  EXPECT_EQ(found->team.findings, kept.team.findings);
  ASSERT_TRUE(found->other_entropies.has_value());
  EXPECT_EQ(found->other_entropies->whole_building_nats, -2.5);
  EXPECT_EQ(found->other_entropies->propagated_nats, 1.25);
  ASSERT_TRUE(found->second_field.has_value());
  EXPECT_EQ(found->second_field->rmse_ppm, 3.5);
  EXPECT_EQ(found->second_field->entropy_nats, -1.5);
  EXPECT_TRUE(found->completed);
  ASSERT_EQ(found->mean_ppm.size(), 1u);
  EXPECT_TRUE(std::isnan(found->mean_ppm[0][0]));
  EXPECT_EQ(found->mean_ppm[0][1], 1.5F);
}

TEST(TrialStore, KeepsThatNobodyWasNear) {
  const TempFolder folder;
  const auto store = TrialStore::Open(folder.path());
  ASSERT_TRUE(store.ok());
  TrialRecord kept = SomeRecord();
  kept.team.closest_m = std::nullopt;
  ASSERT_TRUE(store->Keep("a-1", "print", kept).ok());
  const auto found = store->Find("a-1", "print", kGeometry);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->team.closest_m, std::nullopt);
}

TEST(TrialStore, FindsNothingOfOtherSettingsOrDamaged) {
  const TempFolder folder;
  const auto store = TrialStore::Open(folder.path());
  ASSERT_TRUE(store.ok());
  ASSERT_TRUE(store->Keep("a-1", "print", SomeRecord()).ok());
  EXPECT_FALSE(store->Find("a-2", "print", kGeometry).has_value());
  EXPECT_FALSE(store->Find("a-1", "other", kGeometry).has_value());
  EXPECT_FALSE(store->Find("a-1", "print", {0.0, 0.0, 0.1, 9, 9}).has_value());
  ASSERT_TRUE(WriteFile(folder.File("a-1.json"), "{\"fingerprint\": \"print\"").ok());
  EXPECT_FALSE(store->Find("a-1", "print", kGeometry).has_value());
  ASSERT_TRUE(WriteFile(folder.File("a-1.json"), "{\"fingerprint\": \"print\"}").ok());
  EXPECT_FALSE(store->Find("a-1", "print", kGeometry).has_value());
}

// They are driven again: else means would be of the newer trials alone.
TEST(TrialStore, FindsNothingFromBeforeItKeptCalibrations) {
  const TempFolder folder;
  const auto store = TrialStore::Open(folder.path());
  ASSERT_TRUE(store.ok());
  ASSERT_TRUE(store->Keep("a-1", "print", SomeRecord()).ok());
  constexpr std::uint64_t kMaxBytes = 1 << 20;
  auto value = nlohmann::json::parse(ReadFile(folder.File("a-1.json"), kMaxBytes).value());
  ASSERT_EQ(value.erase("calibration"), 1u);
  ASSERT_TRUE(WriteFile(folder.File("a-1.json"), value.dump()).ok());
  EXPECT_FALSE(store->Find("a-1", "print", kGeometry).has_value());
}

TEST(Fingerprint, TellsSettingsBuildingsSeedsAndTimesApart) {
  MissionOptions mission;
  MissionOptions other_mission;
  other_mission.planning.beta = 2.0;
  Trial trial;
  trial.mission = &mission;
  const std::string print = Fingerprint(trial, 1);
  EXPECT_EQ(Fingerprint(trial, 1), print);
  EXPECT_NE(Fingerprint(trial, 2), print);
  Trial other = trial;
  other.mission = &other_mission;
  EXPECT_NE(Fingerprint(other, 1), print);
  other = trial;
  other.seed = 2;
  EXPECT_NE(Fingerprint(other, 1), print);
  other = trial;
  other.duration_s = 10.0;
  EXPECT_NE(Fingerprint(other, 1), print);
  other = trial;
  other.map_times_s = {5.0};
  EXPECT_NE(Fingerprint(other, 1), print);
  other = trial;
  other.most_late_s = 1.0;
  EXPECT_NE(Fingerprint(other, 1), print);
  other = trial;
  other.ghosts = true;
  EXPECT_NE(Fingerprint(other, 1), print);
  other = trial;
  other.tells_other_entropies = true;
  EXPECT_NE(Fingerprint(other, 1), print);
  other = trial;
  other.robot.lidar_range_m = 4.0;
  const std::string by_robot = Fingerprint(other, 1);
  EXPECT_NE(by_robot, print);
  other.robot.stops_without_frontier = true;
  EXPECT_NE(Fingerprint(other, 1), by_robot);
  other = trial;
  other.robot.leaves_lag_to_mission = true;
  EXPECT_NE(Fingerprint(other, 1), print);
  other = trial;
  other.second_field = GasOptions{};
  const std::string by_field = Fingerprint(other, 1);
  EXPECT_NE(by_field, print);
  other.second_field = PublishedGasOptions();
  EXPECT_NE(Fingerprint(other, 1), by_field);
  other = trial;
  other.rule = TeamRule::kBurgard;
  const std::string by_rule = Fingerprint(other, 1);
  EXPECT_NE(by_rule, print);
  other.rule = TeamRule::kMatching;
  EXPECT_NE(Fingerprint(other, 1), by_rule);
}

// Finished trials are found by it: another form would have them all driven again.
TEST(Fingerprint, KeepsItsForm) {
  const MissionOptions mission;
  Trial trial;
  trial.mission = &mission;
  trial.seed = 7;
  trial.duration_s = 60.0;
  trial.map_times_s = {2.5, 60.0};
  EXPECT_THAT(
      Fingerprint(trial, 0xbeef),
      MatchesRegex("mission [0-9a-f]{8} scene 0000beef robots 1 seed 7 duration 60 maps 2.5 60"));
}

TEST(SceneChecksum, IsOfMapGasStartAndThreshold) {
  const Scene scene = SmallScene();
  const std::uint32_t checksum = SceneChecksum(scene);
  EXPECT_EQ(SceneChecksum(scene), checksum);
  Scene other = scene;
  other.occupancy[0] = CellState::kUnknown;
  EXPECT_NE(SceneChecksum(other), checksum);
  other = scene;
  other.conc_mean_ppm[0] += 1.0F;
  EXPECT_NE(SceneChecksum(other), checksum);
  other = scene;
  ++other.series.counts.back();
  EXPECT_NE(SceneChecksum(other), checksum);
  other = scene;
  other.start_pose.x_m += 0.1;
  EXPECT_NE(SceneChecksum(other), checksum);
  other = scene;
  other.critical_threshold_ppm += 1.0;
  EXPECT_NE(SceneChecksum(other), checksum);
}

}  // namespace trial_store_test
}  // namespace plumescout::lab
