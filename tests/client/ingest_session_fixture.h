// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "absl/synchronization/mutex.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "client/ingest_session.h"
#include "client/join.h"
#include "tests/client/fake_planner_client.h"
#include "tests/client/ingest_traffic.h"

namespace plumescout::client {

inline IngestOptions QuickOptions() {
  IngestOptions options;
  options.backoff = {.initial = absl::Milliseconds(1), .maximum = absl::Milliseconds(5)};
  options.read_slice = absl::Milliseconds(1);
  options.idle_check = absl::Milliseconds(2);
  return options;
}

class IngestSessionFixture : public ::testing::Test {
 protected:
  IngestSession& Start(const IngestOptions& options = QuickOptions(), OpenedLog opened = {}) {
    IngestCallbacks callbacks;
    callbacks.rejoin = [this] { return Join(server_, participation_); };
    callbacks.reclaim = callbacks.rejoin;
    callbacks.on_rolled_back = [this](std::int64_t applied_sequence, std::int64_t forgotten) {
      absl::MutexLock lock(&mutex_);
      rolled_back_.emplace_back(applied_sequence, forgotten);
      ++news_;
    };
    callbacks.on_link = [this](const absl::Status&) {
      absl::MutexLock lock(&mutex_);
      ++news_;
    };
    callbacks.on_rejected = [this](const ObservationRejected& rejected) {
      absl::MutexLock lock(&mutex_);
      rejected_.push_back(rejected.sequence);
    };
    session_ = std::make_unique<IngestSession>(server_, *Join(server_, participation_),
                                               std::move(callbacks), options, std::move(opened));
    return *session_;
  }
  void StartWithDisk(const IngestOptions& options) {
    auto opened = OpenLog(options.store, "m", "r", /*new_epoch=*/100 + drawn_++);
    ASSERT_TRUE(opened.ok()) << opened.status();
    participation_.log_epoch = opened->log.epoch;
    Start(options, *std::move(opened));
  }

  void Append(int count) {
    for (int i = 0; i < count; ++i) {
      const std::int64_t time_ns = static_cast<std::int64_t>(appended_times_.size());
      appended_times_.push_back(time_ns);
      last_ = session_->Append(time_ns, {}, GasReading{});
    }
  }
  // Until one of the statistics that change with the link is so large. False if that takes too
  // long.
  bool AwaitAtLeast(std::int64_t IngestStatistics::*figure, std::int64_t least) {
    const absl::Time deadline = absl::Now() + kPatience;
    absl::MutexLock lock(&mutex_);
    while (session_->statistics().*figure < least) {
      const auto is_new = [this, seen = news_] {
        mutex_.AssertHeld();
        return news_ != seen;
      };
      if (!mutex_.AwaitWithDeadline(absl::Condition(&is_new), deadline)) return false;
    }
    return true;
  }
  absl::Status WaitForAll() { return session_->WaitApplied(last_, kPatience); }

  std::vector<std::int64_t> ReceivedNumbers() const {
    std::vector<std::int64_t> numbers;
    for (const Observation& observation : server_.received()) {
      numbers.push_back(observation.sequence);
    }
    return numbers;
  }
  static std::vector<std::int64_t> Range(std::int64_t first, std::int64_t last) {
    std::vector<std::int64_t> numbers;
    for (std::int64_t n = first; n <= last; ++n) numbers.push_back(n);
    return numbers;
  }

  FakePlannerClient server_;
  Participation participation_{.mission = "m", .robot = "r", .create = MissionOptions{}};
  std::int64_t last_ = 0;
  std::int64_t drawn_ = 0;
  std::vector<std::int64_t> appended_times_;
  absl::Mutex mutex_;
  std::vector<std::pair<std::int64_t, std::int64_t>> rolled_back_;
  std::vector<std::int64_t> rejected_;
  std::int64_t news_ = 0;  // of the link, each after the statistics have it
  std::unique_ptr<IngestSession> session_;
};

}  // namespace plumescout::client
