// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/import_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/server/export_client.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace import_stream_test {

class ImportStreamTest : public ServiceTest {
 protected:
  void SetUp() override { StartServerWithStore(); }
  std::vector<v1::ExportMissionResponse> Export() {
    ExportClient client(*snapshots_, "missions/hall");
    std::vector<v1::ExportMissionResponse> parts;
    for (auto part = client.Read(); part.part_case() != 0; part = client.Read()) {
      parts.push_back(part);
    }
    return parts;
  }
  static void SendFile(const std::vector<v1::ExportMissionResponse>& parts, ImportClient& client) {
    for (const auto& part : parts) {
      if (part.has_piece()) client.Send(part.piece());
      if (part.has_end()) client.Send(part.end());
    }
  }
  bool Exists(const std::string& name) {
    v1::GetMissionRequest request;
    request.set_name(name);
    return Call(missions_, &v1::MissionService::Stub::GetMission, request).ok();
  }
};

TEST_F(ImportStreamTest, AnswersWithTheMission) {
  ImportClient client(*snapshots_);
  client.Open("copy");
  SendFile(Export(), client);
  const auto response = client.Finish();
  ASSERT_TRUE(response.ok()) << response.status();
  EXPECT_EQ(response->mission().name(), "missions/copy");
  EXPECT_TRUE(Exists("missions/copy"));
}

TEST_F(ImportStreamTest, NameThatIsTakenIsRefusedBeforeTheFileComes) {
  ImportClient client(*snapshots_);
  client.Open("hall");
  EXPECT_THAT(client.Finish().status(),
              Refuses(absl::StatusCode::kAlreadyExists, "MISSION_EXISTS"));
}

TEST_F(ImportStreamTest, CallThatEndsWithoutTheEndChangesNothing) {
  const auto parts = Export();
  ImportClient client(*snapshots_);
  client.Open("copy");
  client.Send(parts[1].piece());
  EXPECT_THAT(client.Finish().status(), RefusesField("end"));
  EXPECT_FALSE(Exists("missions/copy"));
}

TEST_F(ImportStreamTest, CallerWhoLeavesChangesNothing) {
  ImportClient client(*snapshots_);
  client.Open("copy");
  client.Send(Export()[1].piece());
  client.Cancel();
  EXPECT_TRUE(absl::IsCancelled(client.Finish().status()));
  EXPECT_FALSE(Exists("missions/copy"));
}

TEST_F(ImportStreamTest, WhoSaysNothingIsHungUpOn) {
  ServerConfig config;
  config.limits.max_wait_s = 0.1;
  StartServerWithStore(config);
  ImportClient client(*snapshots_);
  client.Open("copy");
  EXPECT_TRUE(absl::IsDeadlineExceeded(client.AwaitEnd()));
}

}  // namespace import_stream_test
}  // namespace plumescout::server
