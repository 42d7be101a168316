// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/export_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <random>
#include <thread>

#include "absl/strings/match.h"
#include "absl/synchronization/notification.h"
#include "absl/time/clock.h"
#include "formats/file_sum.h"
#include "formats/mcap/mcap_records.h"
#include "proto/convert/status.h"
#include "tests/server/await_metric.h"
#include "tests/server/export_client.h"
#include "tests/server/held_store.h"
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

// More than a connection takes from who is not read, however it is packed.
void SendMuch(const std::function<void(const v1::ObservationBatch&)>& send) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> ppm(0.0, 1.0);
  constexpr std::int64_t kBatch = 1000;
  for (std::int64_t first = 1; first <= 40 * kBatch; first += kBatch) {
    v1::ObservationBatch batch = GasReadings(first, first + kBatch - 1);
    for (v1::Observation& one : *batch.mutable_observations()) {
      one.mutable_gas()->set_concentration_ppm(ppm(random));
    }
    send(batch);
  }
}

// Takes little of what nobody reads.
std::unique_ptr<v1::SnapshotService::Stub> SmallConnection(const Server& server) {
  grpc::ChannelArguments small;
  small.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
  return v1::SnapshotService::NewStub(grpc::CreateCustomChannel(
      absl::StrCat("127.0.0.1:", server.port()), grpc::InsecureChannelCredentials(), small));
}

TEST_F(ExportStreamTest, WhoReadsNoMoreIsHungUpOn) {
  ServerConfig config;
  config.limits.max_wait_s = 0.2;
  config.limits.max_gas_readings_per_s = 0.0;
  StartServerWithStore(config);
  lease_ = Lease();
  SendMuch([&](const auto& batch) { ASSERT_TRUE(Ingest(kRobot, lease_, batch).ok()); });
  const auto stub = SmallConnection(*server_);
  ExportClient stalled(*stub, "missions/hall", v1::MISSION_FILE_FORMAT_MCAP);
  ASSERT_TRUE(stalled.Read().has_start()) << stalled.Finish();
  // What it held is free for others once it is hung up on; nobody else reads it on.
  const absl::Time deadline = absl::Now() + absl::Seconds(60);
  absl::Status other = absl::UnknownError("not asked");
  while (!other.ok() && absl::Now() < deadline) {
    other = ExportClient(*snapshots_, "missions/hall", v1::MISSION_FILE_FORMAT_MCAP).Finish();
  }
  EXPECT_TRUE(other.ok()) << other;
  EXPECT_FALSE(stalled.Finish().ok());
}

// Holds up who looks for a mission of this name.
class GatedStore : public HeldStore {
 public:
  void Close() { closed_ = true; }
  void Open() {
    if (!opened_.HasBeenNotified()) opened_.Notify();
  }
  void AwaitVisitor() const { visited_.WaitForNotification(); }
  absl::StatusOr<AcquiredMission> Peek(const std::string& key) override {
    if (closed_ && absl::StrContains(key, "attic")) {
      if (!visited_.HasBeenNotified()) visited_.Notify();
      opened_.WaitForNotification();
    }
    return HeldStore::Peek(key);
  }

 private:
  std::atomic<bool> closed_ = false;
  absl::Notification visited_;
  absl::Notification opened_;
};

// The pool that makes exports has one thread and room for one task.
class FullPoolTest : public ServiceTest {
 protected:
  void SetUp() override {
    RegistryHooks hooks;
    hooks.store = &gate_;
    ServerConfig config;
    config.maps.query_threads = 1;
    config.maps.max_queued_queries = 1;
    config.limits.max_gas_readings_per_s = 0.0;
    StartServer(config, hooks);
  }
  void TearDown() override {
    gate_.Open();
    server_ = nullptr;
  }

  // Nothing runs, and nothing waits, for longer than the parts of an export are apart.
  bool AwaitIdlePool() {
    constexpr absl::Duration kIdle = absl::Seconds(1);
    const absl::Time deadline = absl::Now() + absl::Seconds(60);
    absl::Time idle_since = absl::Now();
    while (absl::Now() < deadline) {
      const std::string metrics = server_->MetricsText();
      const bool is_idle =
          absl::StrContains(metrics, "plumescout_pool_queue_depth{pool=\"past\"} 0\n") &&
          absl::StrContains(metrics, "plumescout_pool_busy_threads{pool=\"past\"} 0\n");
      if (!is_idle) idle_since = absl::Now();
      if (absl::Now() - idle_since >= kIdle) return true;
      absl::SleepFor(absl::Milliseconds(1));
    }
    return false;
  }

  GatedStore gate_;
};

TEST_F(FullPoolTest, RefusesWhoBeginsAndHoldsUpWhoHasBegun) {
  ASSERT_TRUE(CreateMission("attic").ok());
  const std::int64_t lease = Lease();
  SendMuch([&](const auto& batch) { ASSERT_TRUE(Ingest(kRobot, lease, batch).ok()); });
  const auto small = SmallConnection(*server_);
  ExportClient begun(*small, "missions/hall");
  ASSERT_TRUE(begun.Read().has_start()) << begun.Finish();

  // Its connection takes no more of what nobody reads: it leaves the pool to others.
  ASSERT_TRUE(AwaitIdlePool());

  gate_.Close();
  ExportClient works(*snapshots_, "missions/attic");
  gate_.AwaitVisitor();
  ExportClient waits(*snapshots_, "missions/attic");
  ASSERT_TRUE(AwaitMetric(*server_, "plumescout_pool_queue_depth{pool=\"past\"} 1"));
  const absl::Status refused = ExportClient(*snapshots_, "missions/hall").Finish();
  EXPECT_THAT(refused, Refuses(absl::StatusCode::kResourceExhausted, "OVERLOADED"));
  EXPECT_TRUE(RetryDelay(refused).has_value());

  absl::Status ended;
  std::thread reader([&] { ended = begun.Finish(); });
  const std::string only_the_other = "plumescout_pool_refused_total{pool=\"past\"} 1\n";
  const absl::Time deadline = absl::Now() + absl::Seconds(60);
  while (absl::StrContains(server_->MetricsText(), only_the_other) && absl::Now() < deadline) {
    std::this_thread::yield();
  }
  EXPECT_LT(absl::Now(), deadline) << "it never met a full pool";
  gate_.Open();
  reader.join();
  EXPECT_TRUE(ended.ok()) << ended;
  EXPECT_EQ(works.Finish(), absl::OkStatus());
  EXPECT_EQ(waits.Finish(), absl::OkStatus());
}

TEST_F(ExportStreamTest, StrangersAreRefused) {
  EXPECT_THAT(ExportClient(*snapshots_, "missions/attic").Finish(),
              Refuses(absl::StatusCode::kNotFound, "MISSION_NOT_FOUND"));
  EXPECT_THAT(ExportClient(*snapshots_, "hall").Finish(), RefusesField("mission"));
}

}  // namespace export_stream_test
}  // namespace plumescout::server
