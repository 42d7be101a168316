// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// The dashboard and the alert rules that ship ask for metrics that a server has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/str_split.h"
#include "tests/server/held_store.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace shipped_dashboards_test {

using ::testing::Contains;
using ::testing::Not;

constexpr char kDashboard[] = "deploy/grafana/plumescout.json";
constexpr char kAlerts[] = "deploy/prometheus/alerts.yml";

// Names that queries may use, off the lines "# TYPE name histogram".
std::set<std::string> NamesIn(const std::string& metrics) {
  std::set<std::string> names;
  for (const absl::string_view line : absl::StrSplit(metrics, '\n')) {
    const std::vector<std::string> words = absl::StrSplit(line, ' ');
    if (words.size() != 4 || words[1] != "TYPE") continue;
    if (words[3] != "histogram") {
      names.insert(words[2]);
      continue;
    }
    for (const char* suffix : {"_bucket", "_sum", "_count"}) names.insert(words[2] + suffix);
  }
  return names;
}

std::vector<std::string> MetricsOf(const std::string& query) {
  static const std::regex kName(R"(\bplumescout_\w+)");
  std::vector<std::string> names;
  for (std::sregex_iterator it(query.begin(), query.end(), kName), end; it != end; ++it) {
    names.push_back(it->str());
  }
  return names;
}

// Every "expr" of a dashboard.
void CollectQueries(const nlohmann::json& json, std::vector<std::string>& queries) {
  if (json.is_object() && json.contains("expr")) queries.push_back(json["expr"].get<std::string>());
  if (!json.is_structured()) return;
  for (const nlohmann::json& part : json) CollectQueries(part, queries);
}

class ShippedDashboardsTest : public ServiceTest {
 protected:
  ~ShippedDashboardsTest() override { server_.reset(); }

  // On a store: only then is there something to tell of it.
  void StartStoredServer() {
    RegistryHooks hooks;
    hooks.store = &store_;
    StartServer({}, hooks);
  }
  void ExpectKnown(const std::vector<std::string>& queries) {
    StartStoredServer();
    const std::set<std::string> known = NamesIn(server_->MetricsText());
    for (const std::string& query : queries) {
      const std::vector<std::string> names = MetricsOf(query);
      EXPECT_TRUE(!names.empty() || absl::StrContains(query, "up{")) << query;
      for (const std::string& name : names) EXPECT_THAT(known, Contains(name)) << query;
    }
  }

  HeldStore store_;
};

TEST_F(ShippedDashboardsTest, NamesAreTold) {
  StartServer();
  const std::set<std::string> known = NamesIn(server_->MetricsText());
  EXPECT_THAT(known, Contains("plumescout_rpc_duration_seconds_bucket"));
  EXPECT_THAT(known, Not(Contains("plumescout_rpc_duration_seconds")));
  EXPECT_THAT(known, Contains("plumescout_mission_watchers"));
}

TEST_F(ShippedDashboardsTest, DashboardAsksForWhatThereIs) {
  std::ifstream file(kDashboard);
  const auto dashboard = nlohmann::json::parse(file);
  std::vector<std::string> queries;
  CollectQueries(dashboard, queries);
  EXPECT_GE(queries.size(), 20u);
  ExpectKnown(queries);
}

TEST_F(ShippedDashboardsTest, AlertsAskForWhatThereIs) {
  std::vector<std::string> queries;
  const YAML::Node alerts = YAML::LoadFile(kAlerts);
  for (const YAML::Node& group : alerts["groups"]) {
    for (const YAML::Node& rule : group["rules"]) {
      queries.push_back(rule["expr"].as<std::string>());
      EXPECT_TRUE(rule["annotations"]["summary"].IsDefined()) << rule["alert"];
    }
  }
  EXPECT_GE(queries.size(), 10u);
  ExpectKnown(queries);
}

}  // namespace shipped_dashboards_test
}  // namespace plumescout::server
