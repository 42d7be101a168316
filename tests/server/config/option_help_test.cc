// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/option_help.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "google/protobuf/descriptor.h"
#include "plumescout/config/v1/server_config.pb.h"

namespace plumescout::server {
namespace option_help_test {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(OptionHelpTest, SaysDefaultAndMeaning) {
  const std::string help = OptionHelp();
  EXPECT_THAT(help,
              HasSubstr("  limits.max_missions = 8\n      Missions at one time, 1 to 1e6.\n"));
  EXPECT_THAT(help, HasSubstr("  listen = 127.0.0.1:50551\n"));
  EXPECT_THAT(help, HasSubstr("  mission.gas.refresh_period_s = 0.05\n"));
  EXPECT_THAT(help, HasSubstr("  mission.planning.grid_guard = true\n"));
  EXPECT_THAT(help, HasSubstr("  mission.home = unset\n"));
  EXPECT_THAT(help, HasSubstr("  mission.frontier.observed_variance_ppm2 = unset\n"));
}

TEST(OptionHelpTest, NamesTheChoices) {
  EXPECT_THAT(
      OptionHelp(),
      HasSubstr("  mission.planning.selection_rule = information_rate\n      Selection. One "
                "of least_cost, mean_ucb, information_rate.\n"));
}

// Names of all scalar options below `message`, "threads" of "planning.threads".
void CollectScalars(const google::protobuf::Descriptor& message, std::vector<std::string>& names) {
  for (int i = 0; i < message.field_count(); ++i) {
    const auto& field = *message.field(i);
    const std::string& type = field.message_type() ? field.message_type()->name() : "";
    if (type == "PriorMap") continue;  // no option
    if (absl::EndsWith(type, "Config") || absl::EndsWith(type, "Options")) {
      CollectScalars(*field.message_type(), names);
    } else {
      names.push_back(field.name());
    }
  }
}

TEST(OptionHelpTest, ListsEveryOptionOnce) {
  std::vector<std::string> names;
  CollectScalars(*config::v1::ServerConfig::descriptor(), names);
  const std::vector<std::string> lines = absl::StrSplit(OptionHelp(), '\n');
  for (const std::string& name : names) {
    const auto wanted = std::count(names.begin(), names.end(), name);
    EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                            [&](const std::string& line) {
                              return absl::StrContains(line, absl::StrCat(" ", name, " = ")) ||
                                     absl::StrContains(line, absl::StrCat(".", name, " = "));
                            }),
              wanted)
        << name;
  }
  EXPECT_THAT(OptionHelp(), Not(HasSubstr("prior_map")));
}

TEST(OptionHelpTest, EveryOptionIsExplainedAndNoLineIsTooLong) {
  const std::vector<std::string> lines = absl::StrSplit(OptionHelp(), '\n');
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    EXPECT_LE(lines[i].size(), 100u) << lines[i];
    if (absl::StrContains(lines[i], " = ") && lines[i][2] != ' ') {
      EXPECT_TRUE(absl::StartsWith(lines[i + 1], "      ")) << lines[i];
      EXPECT_GT(lines[i + 1].size(), 10u) << lines[i];
    }
  }
}

}  // namespace option_help_test
}  // namespace plumescout::server
