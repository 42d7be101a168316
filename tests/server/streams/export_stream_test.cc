// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/export_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/strings/match.h"
#include "formats/file_sum.h"
#include "formats/mcap/mcap_records.h"
#include "tests/server/export_client.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace export_stream_test {

class ExportStreamTest : public ServiceTest {
 protected:
  void SetUp() override {
    StartServerWithStore();
    lease_ = Lease();
  }
  void Send(std::int64_t first, std::int64_t last) {
    ASSERT_TRUE(Ingest(kRobot, lease_, GasReadings(first, last)).ok());
  }

  std::int64_t lease_ = 0;
};

TEST_F(ExportStreamTest, StartPiecesAndEndComeInOrder) {
  Send(1, 500);
  ExportClient client(*snapshots_, "missions/hall");
  auto part = client.Read();
  ASSERT_TRUE(part.has_start());
  EXPECT_EQ(part.start().revision(), Revision());
  FileSum sum;
  for (part = client.Read(); part.has_piece(); part = client.Read()) {
    EXPECT_EQ(part.piece().offset_bytes(), sum.bytes());
    sum.Add(part.piece().data());
  }
  ASSERT_TRUE(part.has_end());
  EXPECT_EQ(part.end().total_bytes(), sum.bytes());
  EXPECT_EQ(part.end().sha256(), sum.TakeSha256());
  EXPECT_TRUE(client.Finish().ok());
}

TEST_F(ExportStreamTest, MissionGoesOnMeanwhile) {
  Send(1, 10);
  ExportClient client(*snapshots_, "missions/hall");
  ASSERT_EQ(client.Read().start().revision(), 11);
  Send(11, 20);
  EXPECT_EQ(Revision(), 21);
  EXPECT_TRUE(client.Finish().ok());
}

TEST_F(ExportStreamTest, CallerMayLeave) {
  Send(1, 10);
  ExportClient client(*snapshots_, "missions/hall");
  ASSERT_TRUE(client.Read().has_start());
  client.Cancel();
  client.Finish().IgnoreError();
  EXPECT_TRUE(ExportClient(*snapshots_, "missions/hall").Finish().ok());
}

TEST_F(ExportStreamTest, AMissionComesAsMcapToo) {
  Send(1, 500);
  ExportClient client(*snapshots_, "missions/hall", v1::MISSION_FILE_FORMAT_MCAP);
  ASSERT_EQ(client.Read().start().revision(), Revision());
  std::string bytes;
  FileSum sum;
  auto part = client.Read();
  for (; part.has_piece(); part = client.Read()) {
    bytes += part.piece().data();
    sum.Add(part.piece().data());
    EXPECT_EQ(part.piece().crc32(), sum.crc32());
  }
  ASSERT_TRUE(part.has_end());
  EXPECT_EQ(part.end().sha256(), sum.TakeSha256());
  EXPECT_TRUE(client.Finish().ok());
  EXPECT_TRUE(absl::StartsWith(bytes, kMcapMagic) && absl::EndsWith(bytes, kMcapMagic));
  // What it held is free again for the next.
  EXPECT_TRUE(
      ExportClient(*snapshots_, "missions/hall", v1::MISSION_FILE_FORMAT_MCAP).Finish().ok());
}

TEST_F(ExportStreamTest, StrangersAreRefused) {
  EXPECT_THAT(ExportClient(*snapshots_, "missions/attic").Finish(),
              Refuses(absl::StatusCode::kNotFound, "MISSION_NOT_FOUND"));
  EXPECT_THAT(ExportClient(*snapshots_, "hall").Finish(), RefusesField("mission"));
}

}  // namespace export_stream_test
}  // namespace plumescout::server
