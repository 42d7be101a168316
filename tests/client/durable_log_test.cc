// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What the log of a robot, in memory and on disk, promises together with a server that crashes and
// is set back: every observation is applied once, or declared missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/log_store.h"
#include "client/robot_log.h"
#include "core/types/rng.h"
#include "tests/client/log_traffic.h"
#include "tests/support/temp_folder.h"

namespace plumescout::client {
namespace durable_log_test {

constexpr std::int64_t kEpoch = 7;

// What a server holds of one robot's log.
struct ServerLog {
  std::vector<Observation> applied;
  std::size_t durable = 0;  // of these

  std::int64_t AppliedSequence() const {
    return applied.empty() ? 0 : LastSequence(applied.back());
  }
  std::int64_t DurableSequence() const {
    return durable == 0 ? 0 : LastSequence(applied[durable - 1]);
  }
  void FallBackTo(std::size_t size) {
    applied.resize(size);
    durable = size;
  }
};

// A robot with its disk, and a server. Observations are told apart by their sample time.
class World {
 public:
  explicit World(std::uint64_t seed) : rng_(seed) { Boot(); }

  void Step() {
    switch (rng_.Below(12)) {
      case 0:
        return Boot();
      case 1:
        LosePower();
        return Boot();
      case 2:
        return Crash(server_.durable);
      case 3:
        return Crash(rng_.Below(server_.durable + 1));  // an older copy
      case 4:
        Crash(rng_.Below(server_.durable + 1));
        return Boot();
      case 5:
      case 6:
        server_.durable += rng_.Below(server_.applied.size() - server_.durable + 1);
        return Acknowledge();
      case 7:
        store_->DropBefore(log_->first_held_sequence());
        return;
      case 8:
        return Sync();
      default:
        Sense(rng_.Below(10));
        return Send(rng_.Below(20));
    }
  }

  // Everything is sent, and nothing was told twice or lost but what was declared or died with the
  // power.
  void Check() {
    Send(1'000'000);
    ASSERT_EQ(server_.AppliedSequence(), log_->last_sequence());
    std::map<std::int64_t, int> times;
    std::int64_t expected = 1;
    for (const Observation& entry : server_.applied) {
      ASSERT_EQ(entry.sequence, expected);
      expected = LastSequence(entry) + 1;
      if (!std::holds_alternative<SequenceGap>(entry.payload)) ++times[entry.sample_time_ns];
    }
    for (const auto& [sensed, count] : times) ASSERT_EQ(count, 1) << "observation " << sensed;
    // Within the memory of the log nothing is ever declared missing that was on disk.
    const std::int64_t missing = sensed_ - static_cast<std::int64_t>(times.size());
    ASSERT_LE(missing, lost_with_power_ + dropped_);
  }

 private:
  // The process of the robot ends and starts again.
  void Boot() {
    WriteToDisk();
    store_.reset();
    if (log_.has_value()) first_held_ = log_->first_held_sequence();
    auto opened = OpenLog(options_, "hall", "scout", kEpoch);
    ASSERT_TRUE(opened.ok()) << opened.status();
    store_ = std::move(opened->store);
    log_.emplace(RobotLogOptions{.max_observations = 60, .max_durable_bytes = 4000});
    log_->Restore(std::move(opened->log));
    log_->SkipTo(server_.AppliedSequence());
    written_ = synced_ = log_->last_sequence();
    NoteSyncedBytes();
    Acknowledge();
    // A gap takes a place in a full log.
    dropped_ += std::max<std::int64_t>(
        log_->first_held_sequence() - std::max(first_held_, server_.AppliedSequence() + 1), 0);
  }

  void WriteToDisk() {
    if (store_ == nullptr) return;
    const ReadLimits all = {.through_sequence = log_->last_sequence(),
                            .max_observations = 1000,
                            .max_bytes = std::size_t{1} << 30};
    for (const Observation& entry : log_->Read(written_ + 1, all)) {
      if (std::holds_alternative<SequenceGap>(entry.payload)) continue;
      ASSERT_TRUE(store_->Append(entry).ok());
    }
    written_ = log_->last_sequence();
    ASSERT_TRUE(store_->Append(LogMark{log_->applied_sequence(), log_->durable_sequence()}).ok());
  }

  void Sync() {
    WriteToDisk();
    ASSERT_TRUE(store_->Sync().ok());
    synced_ = written_;
    NoteSyncedBytes();
  }

  void NoteSyncedBytes() {
    const std::vector<std::string> segments = SegmentsIn(options_.folder);
    synced_bytes_ = segments.empty() ? 0 : std::filesystem::file_size(segments.back());
    synced_segment_ = segments.empty() ? "" : segments.back();
  }

  // What was not synced of the last segment is gone in part; what is only in memory is, too.
  void LosePower() {
    const std::vector<std::string> segments = SegmentsIn(options_.folder);
    lost_with_power_ += log_->last_sequence() - synced_;
    written_ = log_->last_sequence();  // never will be
    store_.reset();
    first_held_ = log_->first_held_sequence();
    log_.reset();
    if (segments.empty() || synced_segment_ != segments.back()) return;
    const std::uint64_t held_bytes = std::filesystem::file_size(segments.back());
    if (held_bytes <= synced_bytes_) return;
    std::filesystem::resize_file(segments.back(),
                                 synced_bytes_ + rng_.Below(held_bytes - synced_bytes_ + 1));
  }

  void Crash(std::size_t kept) {
    dropped_ += std::max<std::int64_t>(
        log_->first_held_sequence() - 1 - (kept == 0 ? 0 : LastSequence(server_.applied[kept - 1])),
        0);
    server_.FallBackTo(kept);
    Acknowledge();
  }

  void Sense(std::uint64_t count) {
    const std::int64_t lost_before = log_->lost_observations();
    for (std::uint64_t i = 0; i < count; ++i) log_->Append(++sensed_, {}, GasReading{});
    dropped_ += log_->lost_observations() - lost_before;
  }

  void Send(std::uint64_t most) {
    const ReadLimits limits = {.through_sequence = log_->last_sequence(),
                               .max_observations = most,
                               .max_bytes = std::size_t{1} << 30};
    if (most == 0) return;
    for (const Observation& entry : log_->Read(server_.AppliedSequence() + 1, limits)) {
      server_.applied.push_back(entry);
    }
    Acknowledge();
  }

  void Acknowledge() { log_->Acknowledge(server_.AppliedSequence(), server_.DurableSequence()); }

  Rng rng_;
  const TempFolder folder_;
  const LogStoreOptions options_{.folder = folder_.File("log"), .segment_bytes = 1500};
  std::unique_ptr<LogStore> store_;
  std::optional<RobotLog> log_;
  ServerLog server_;
  std::int64_t first_held_ = 1;  // by the robot's process before this one
  std::int64_t written_ = 0;
  std::int64_t synced_ = 0;
  std::uint64_t synced_bytes_ = 0;
  std::string synced_segment_;
  std::int64_t sensed_ = 0;
  std::int64_t lost_with_power_ = 0;
  std::int64_t dropped_ = 0;  // from a full log, or forgotten when a server was set back
};

TEST(DurableLogTest, EveryObservationIsAppliedOnceOrDeclaredMissing) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    World world(seed);
    for (int step = 0; step < 120; ++step) world.Step();
    world.Check();
    if (testing::Test::HasFatalFailure()) FAIL() << "seed " << seed;
  }
}

}  // namespace durable_log_test
}  // namespace plumescout::client
