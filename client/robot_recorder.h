// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "client/robot_observer.h"
#include "client/robot_recording.h"
#include "client/robot_view.h"

namespace plumescout::client {

// Records a robot's run while it goes on, on a thread of its own: the robot never waits for the
// disk. What is to be written waits in a queue, which is bounded; what goes beyond is dropped, and
// the file tells how much. Tells another observer of everything, too. Thread-safe.
class RobotRecorder final : public RobotObserver {
 public:
  // What waits, by estimate: minutes of a robot that scans ten times a second.
  static constexpr std::int64_t kMaxQueuedBytes = std::int64_t{4} << 20;

  // As of RobotRecording; people are told on the recorder's thread. `next` is not owned and
  // outlives this.
  RobotRecorder(const RobotRecordingOptions& options, const Participation& participation,
                std::int64_t time_ns, RobotObserver* next,
                std::int64_t max_queued_bytes = kMaxQueuedBytes);
  // Writes what waits, and ends the file.
  ~RobotRecorder() override;
  RobotRecorder(const RobotRecorder&) = delete;
  RobotRecorder& operator=(const RobotRecorder&) = delete;

  // What people are told is in the file as well.
  void OnSaid(bool is_warning, const std::string& line) { Push(SaidLine{is_warning, line}); }

  void OnTick(const RobotTick& tick) override;
  void OnLogged(const Observation& observation) override;
  void OnPlan(const PlanArrival& arrival) override;
  void OnReport(PlanId plan, ProgressOutcome outcome) override;
  void OnPlanFailure(const absl::Status& status) override { next_.OnPlanFailure(status); }
  void OnPlaceDoubted(bool doubted) override { next_.OnPlaceDoubted(doubted); }
  void OnRejected(const ObservationRejected& rejected) override { next_.OnRejected(rejected); }
  void OnLink(const absl::Status& status) override { next_.OnLink(status); }
  void OnRolledBack(std::int64_t applied_sequence, std::int64_t forgotten) override {
    next_.OnRolledBack(applied_sequence, forgotten);
  }
  void OnDisk(const absl::Status& status) override { next_.OnDisk(status); }

 private:
  struct Item {
    RobotNews news;
    std::int64_t missing = 0;  // dropped before it
    std::int64_t bytes = 0;
  };

  void Push(RobotNews news);
  void Run();
  // Waits for one a while. Nothing: there was none; `stops` if none will come.
  std::optional<Item> Take(bool& stops);
  bool HasWork() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return !items_.empty() || stopping_;
  }

  RobotObserver& next_;
  const std::int64_t max_queued_bytes_;
  std::optional<std::int64_t> place_ns_;  // told last; of the robot's thread
  RobotRecording recording_;              // of the thread

  absl::Mutex mutex_;
  std::deque<Item> items_ ABSL_GUARDED_BY(mutex_);
  std::int64_t queued_bytes_ ABSL_GUARDED_BY(mutex_) = 0;
  std::int64_t missing_ ABSL_GUARDED_BY(mutex_) = 0;  // dropped since the last that was not
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;

  std::thread thread_;  // last: it uses all of the above
};

}  // namespace plumescout::client
