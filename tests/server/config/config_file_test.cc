// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/config_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "google/protobuf/descriptor.h"
#include "google/protobuf/util/message_differencer.h"
#include "server/config/config_convert.h"

namespace plumescout::server {
namespace config_file_test {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

constexpr char kShipped[] = "deploy/config/plumescout.yaml";

std::string ShippedText() {
  std::ifstream file(kShipped);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string ErrorOf(const std::string& yaml) {
  ConfigBuilder builder;
  const absl::Status added = builder.AddYaml(yaml, "test.yaml");
  return std::string(added.ok() ? builder.Build().status().message() : added.message());
}

TEST(ConfigFileTest, ShippedFileHoldsTheDefaultsOfTheProgram) {
  ConfigBuilder builder;
  const absl::Status added = builder.AddFile(kShipped);
  ASSERT_TRUE(added.ok()) << added;
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(
      ServerConfigToProto(*builder.Build()), ServerConfigToProto(ProgramDefaults())));
}

// Expects a line "name:" of each field, commented out or not.
void ExpectNamed(const google::protobuf::Descriptor& message, const std::string& text) {
  for (int i = 0; i < message.field_count(); ++i) {
    const auto& field = *message.field(i);
    if (field.name() == "prior_map") continue;  // of one building
    EXPECT_THAT(text, ContainsRegex("(^|[ \n])" + field.name() + ":"));
    if (field.message_type() != nullptr) ExpectNamed(*field.message_type(), text);
  }
}

TEST(ConfigFileTest, ShippedFileNamesEveryOption) {
  ExpectNamed(*config::v1::ServerConfig::descriptor(), ShippedText());
}

TEST(ConfigFileTest, APriorMapIsNoOption) {
  EXPECT_THAT(ErrorOf("mission: {prior_map: {cells: {deflated_data: abc}}}"),
              HasSubstr("mission.prior_map.cells.deflated_data is not an option"));
}

TEST(ConfigFileTest, LaterSettingsWin) {
  ConfigBuilder builder;
  ASSERT_TRUE(builder.AddYaml("limits: {max_missions: 3}\nmission: {seed: 5}", "a.yaml").ok());
  ASSERT_TRUE(builder.Set("limits.max_missions", "4").ok());
  const auto config = builder.Build();
  EXPECT_EQ(config->limits.max_missions, 4);
  EXPECT_EQ(config->mission.seed, 5u);
}

TEST(ConfigFileTest, ErrorsNameTheLine) {
  EXPECT_EQ(ErrorOf("limits:\n  max_missions: 3\n  max_mision: 3\n"),
            "test.yaml:3: limits.max_mision is not an option");
  EXPECT_EQ(ErrorOf("planning:\n  threads: 0\n"),
            "test.yaml:2: planning.threads = 0 must be in [1, 256]");
  EXPECT_EQ(ErrorOf("mission:\n  planning:\n    cost: free\n"),
            "test.yaml:3: mission.planning.cost = free must be one of ucb, euclidean, vertices");
  EXPECT_EQ(ErrorOf("planning:\n  threads: many\n"),
            "test.yaml:2: planning.threads = many must be a whole number of 32 bits");
  EXPECT_EQ(ErrorOf("mission:\n  gas:\n    lattice_factor: 17\n"),
            "test.yaml:3: mission.gas.lattice_factor = 17 must be in [1, 16]");
  EXPECT_EQ(ErrorOf("planning:\n"), "test.yaml:1: planning has no value");
  EXPECT_EQ(ErrorOf("planning: [1, 2]\n"), "test.yaml:1: planning has no value");
  EXPECT_THAT(ErrorOf("a: b: c\n"), HasSubstr("test.yaml:1: "));
  EXPECT_EQ(ErrorOf("- 1\n"), "test.yaml:1: must be a mapping");
}

TEST(ConfigFileTest, ListsOfMappingsAreRead) {
  ConfigBuilder builder;
  const std::string yaml =
      "mission:\n"
      "  home: {x_m: 1.5, y_m: -2}\n"
      "  keep_out:\n"
      "    - vertices: [{x_m: 0, y_m: 0}, {x_m: 2, y_m: 0}, {x_m: 0, y_m: 3}]\n"
      "    - vertices: [{x_m: 5, y_m: 5}, {x_m: 6, y_m: 5}, {x_m: 6, y_m: 6}, {x_m: 5, y_m: 6}]\n";
  ASSERT_EQ(builder.AddYaml(yaml, "a.yaml"), absl::OkStatus());
  ASSERT_EQ(builder.Set("mission.keep_out[0].vertices[2].y_m", "4"), absl::OkStatus());
  const auto config = builder.Build();
  ASSERT_TRUE(config.ok()) << config.status();
  EXPECT_EQ(config->mission.home, (Point2{1.5, -2.0}));
  ASSERT_EQ(config->mission.keep_out.size(), 2u);
  EXPECT_EQ(config->mission.keep_out[0], (Polygon{{{0, 0}, {2, 0}, {0, 4}}}));
  EXPECT_EQ(config->mission.keep_out[1].vertices.size(), 4u);
  EXPECT_EQ(ErrorOf("mission:\n  keep_out: [1]\n"), "test.yaml:2: mission.keep_out has no value");
  EXPECT_EQ(ErrorOf("mission:\n  keep_out:\n    - corners: 3\n"),
            "test.yaml:3: mission.keep_out[0].corners is not an option");
}

TEST(ConfigFileTest, AMappingThatHoldsItselfIsRefused) {
  EXPECT_THAT(ErrorOf("mission: &all\n  gas: *all\n"),
              ContainsRegex("^test.yaml:2: mission.gas.gas.*is not an option"));
}

TEST(ConfigFileTest, EmptyFileIsTheDefault) { EXPECT_EQ(ErrorOf(""), ""); }

TEST(ConfigFileTest, MissingFileIsNotFound) {
  ConfigBuilder builder;
  EXPECT_TRUE(absl::IsNotFound(builder.AddFile("/no/such/file.yaml")));
}

TEST(ConfigFileTest, ALaterSettingIsNotBlamedOnTheFile) {
  ConfigBuilder builder;
  ASSERT_TRUE(builder.AddYaml("planning:\n  threads: 2\n", "a.yaml").ok());
  ASSERT_TRUE(builder.Set("planning.threads", "0").ok());
  EXPECT_EQ(builder.Build().status().message(), "planning.threads = 0 must be in [1, 256]");
}

TEST(ConfigFileTest, OptionsOfMissionsAreValidated) {
  ConfigBuilder builder;
  ASSERT_TRUE(builder.Set("mission.gas.prior_precision_per_ppm2", "-1").ok());
  EXPECT_THAT(std::string(builder.Build().status().message()),
              HasSubstr("mission.gas.prior_precision_per_ppm2 = -1"));
}

TEST(ConfigFileTest, QueueMustHoldAWindowAndABatch) {
  ConfigBuilder builder;
  ASSERT_TRUE(builder.Set("limits.max_queued_observations", "10").ok());
  EXPECT_THAT(std::string(builder.Build().status().message()),
              HasSubstr("limits.max_queued_observations = 10"));
}

}  // namespace config_file_test
}  // namespace plumescout::server
