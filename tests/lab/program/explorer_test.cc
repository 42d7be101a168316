// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/explorer.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "absl/strings/escaping.h"
#include "plumescout/v1/options.pb.h"
#include "proto/convert/map.h"
#include "proto/convert/plan.h"
#include "tests/lab/sim/small_scene.h"

namespace plumescout::lab {
namespace explorer_test {

MapSnapshot MapOfTheScene() {
  MapSnapshot map;
  map.occupancy = SmallWorld().scene().occupancy;
  map.gas_mean_ppm = SmallWorld().scene().conc_mean_ppm;
  map.gas_variance_ppm2 = Grid<float>(map.occupancy.geometry(), 0.25F);
  map.robots = {{.id = "robot-1", .has_pose = true, .pose = {1.0, 2.0, 0.5}}};
  return map;
}

TeamResult TeamOfOne() {
  TeamResult team;
  team.robots.resize(1);
  team.robots[0].robot = "robot-1";
  team.robots[0].path = {{0.0, {1.0, 2.0, 0.0}}, {0.1, {1.001, 2.0, 0.1}}, {0.2, {1.5, 2.25, 0.0}}};
  IssuedPlan issued;
  issued.time_s = 3.5;
  issued.plan.id = 7;
  issued.plan.robot = "robot-1";
  issued.plan.explanation = "Drive on";
  team.robots[0].plans = {issued};
  return team;
}

lab::Run RunOf(const TeamResult& team, const MapSnapshot& map) {
  return {.world = SmallWorld(), .team = team, .final_map = map, .strategy = "plumescout"};
}

// What is written in place of the mission.
nlohmann::json MissionIn(const TeamResult& team,
                         const std::optional<ObjectiveOutcome>& objective = {}) {
  const MapSnapshot map = MapOfTheScene();
  lab::Run run = RunOf(team, map);
  run.objective = objective;
  const std::string page = MakeExplorer("<b>@mission@</b>", run);
  EXPECT_EQ(page.substr(0, 3), "<b>");
  EXPECT_EQ(page.substr(page.size() - 4), "</b>");
  EXPECT_EQ(page.find('<', 1), page.size() - 4);  // nothing ends the element it stands in
  return nlohmann::json::parse(page.substr(3, page.size() - 7));
}

template <typename Message>
Message Decode(const nlohmann::json& base64) {
  std::string bytes;
  Message message;
  EXPECT_TRUE(absl::Base64Unescape(base64.get<std::string>(), &bytes));
  EXPECT_TRUE(message.ParseFromString(bytes));
  return message;
}

TEST(Explorer, MapsAreReadAsThoseOfAServer) {
  const nlohmann::json mission = MissionIn(TeamOfOne());
  const auto map = FromProto(Decode<v1::GetMapResponse>(mission["map"]));
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->occupancy, SmallWorld().scene().occupancy);
  EXPECT_NEAR(map->gas_variance_ppm2[0], 0.25, 1e-6);
  ASSERT_EQ(map->robots.size(), 1U);
  EXPECT_EQ(map->robots[0].pose, (Pose2{1.0, 2.0, 0.5}));
  const auto truth = Decode<v1::GetMapResponse>(mission["truth"]);
  EXPECT_EQ(truth.tile_geometry().column_count(), SmallWorld().scene().geometry().width);
  EXPECT_EQ(truth.tiles_size(), 2);
}

TEST(Explorer, PlansAndWaysAreThere) {
  const nlohmann::json mission = MissionIn(TeamOfOne());
  ASSERT_EQ(mission["plans"].size(), 1U);
  EXPECT_EQ(mission["plans"][0]["time_s"], 3.5);
  const auto plan = Decode<v1::Plan>(mission["plans"][0]["plan"]);
  EXPECT_EQ(plan.explanation(), "Drive on");
  EXPECT_EQ(mission["ways"][0]["robot"], plan.robot());
  // To the centimetre, and a robot that stands is at one place.
  EXPECT_EQ(mission["ways"][0]["points_m"].dump(), "[[1.0,2.0],[1.5,2.25]]");
  EXPECT_EQ(mission["homes_m"].dump(), "[[1.0,2.0]]");
  EXPECT_EQ(mission["sources_m"].size(), SmallWorld().scene().sources.size());
}

TEST(Explorer, HowTheObjectiveStandsIsThereCellByCell) {
  EXPECT_TRUE(MissionIn(TeamOfOne())["objective"].is_null());
  ObjectiveOutcome outcome;
  outcome.asked = {.kind = ObjectiveKind::kConfirmClean, .threshold_ppm = 12.0};
  outcome.verdicts = Grid<ObjectiveVerdict>(SmallWorld().scene().geometry());
  outcome.verdicts[1] = ObjectiveVerdict::kRefuted;
  const nlohmann::json objective = MissionIn(TeamOfOne(), outcome)["objective"];
  const auto asked = Decode<v1::ObjectiveOptions>(objective["asked"]);
  EXPECT_EQ(asked.kind(), v1::OBJECTIVE_KIND_CONFIRM_CLEAN);
  EXPECT_EQ(asked.threshold_ppm(), 12.0);
  std::string verdicts;
  ASSERT_TRUE(absl::Base64Unescape(objective["verdicts"].get<std::string>(), &verdicts));
  ASSERT_EQ(verdicts.size(), outcome.verdicts.size());
  EXPECT_EQ(verdicts[0], static_cast<char>(v1::OBJECTIVE_VERDICT_DOES_NOT_COUNT));
  EXPECT_EQ(verdicts[1], static_cast<char>(v1::OBJECTIVE_VERDICT_REFUTED));
}

TEST(Explorer, WithoutAPlaceForTheMissionThereIsNone) {
  const TeamResult team = TeamOfOne();
  const MapSnapshot map = MapOfTheScene();
  EXPECT_EQ(MakeExplorer("", RunOf(team, map)), "");
  EXPECT_EQ(MakeExplorer("<p>another page</p>", RunOf(team, map)), "");
}

}  // namespace explorer_test
}  // namespace plumescout::lab
