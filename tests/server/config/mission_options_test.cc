// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/mission_options.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "absl/strings/str_replace.h"
#include "proto/convert/status.h"

namespace plumescout::server {
namespace mission_options_test {

TEST(MissionOptionsTest, NamedStrategySetsThePartsOfItsRow) {
  v1::MissionOptions proto;
  proto.mutable_planning()->set_strategy("xit_f");
  const auto options = ReadMissionOptions(proto, {}, "options");
  ASSERT_TRUE(options.ok()) << options.status();
  EXPECT_EQ(options->planning.goal_policy, GoalPolicy::kOccupancyOnly);
}

TEST(MissionOptionsTest, FieldsThatAreSetOverrideTheRow) {
  v1::MissionOptions proto;
  proto.mutable_planning()->set_strategy("xit_f");
  proto.mutable_planning()->set_goal_policy(v1::GOAL_POLICY_OCCUPANCY_FIRST);
  EXPECT_EQ(ReadMissionOptions(proto, {}, "options")->planning.goal_policy,
            GoalPolicy::kOccupancyFirst);
}

TEST(MissionOptionsTest, WithoutANameTheDefaultsStay) {
  MissionOptions defaults;
  defaults.planning.goal_policy = GoalPolicy::kOccupancyFirst;
  defaults.gas.prior_precision_per_ppm2 = 7.0;
  const auto options = ReadMissionOptions({}, defaults, "options");
  EXPECT_EQ(options->planning.goal_policy, GoalPolicy::kOccupancyFirst);
  EXPECT_EQ(options->gas.prior_precision_per_ppm2, 7.0);
}

constexpr char kYaml[] =
    "resolution: 0.1\norigin: [1.0, -2.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";
constexpr char kPgm[] = "P5 3 1 255\n\xfe\xfe\x01";

v1::MissionOptions WithFiles(const std::string& yaml, const std::string& pgm) {
  v1::MissionOptions proto;
  proto.mutable_prior_map()->mutable_files()->set_yaml(yaml);
  proto.mutable_prior_map()->mutable_files()->set_pgm(pgm);
  return proto;
}

TEST(MissionOptionsTest, PriorMapIsReadFromItsFiles) {
  const auto options = ReadMissionOptions(WithFiles(kYaml, kPgm), {}, "options");
  ASSERT_TRUE(options.ok()) << options.status();
  ASSERT_NE(options->prior_map, nullptr);
  EXPECT_EQ(options->prior_map->geometry(), (GridGeometry{1.0, -2.0, 0.1, 3, 1}));
  EXPECT_EQ(options->prior_map->values(),
            (std::vector<CellState>{CellState::kFree, CellState::kFree, CellState::kOccupied}));
}

TEST(MissionOptionsTest, FilesThatDoNotParseAreRefusedByTheirField) {
  const auto blamed = [](const std::string& yaml, const std::string& pgm) {
    const absl::Status status = ReadMissionOptions(WithFiles(yaml, pgm), {}, "options").status();
    EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
    return FieldViolations(status).at(0).field;
  };
  EXPECT_EQ(blamed("", kPgm), "options.prior_map.files.yaml");
  EXPECT_EQ(blamed(absl::StrReplaceAll(kYaml, {{"0.0]", "1.5]"}}), kPgm),
            "options.prior_map.files.yaml");
  EXPECT_EQ(blamed(kYaml, "P5 3 1 255\n."), "options.prior_map.files.pgm");
  EXPECT_EQ(blamed(absl::StrReplaceAll(kYaml, {{"resolution: 0.1", "resolution: 0.3"}}), kPgm),
            "options.prior_map");
}

TEST(MissionOptionsTest, UnknownStrategyIsRefusedByItsField) {
  v1::MissionOptions proto;
  proto.mutable_planning()->set_strategy("teleport");
  const auto options = ReadMissionOptions(proto, {}, "options");
  EXPECT_EQ(FieldViolations(options.status()).at(0).field, "options.planning.strategy");
}

}  // namespace mission_options_test
}  // namespace plumescout::server
