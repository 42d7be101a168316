// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "absl/time/time.h"
#include "core/types/ids.h"

namespace plumescout::lab {

// Watches a mission's map as an operator's console does, and hears how far each robot's log is in
// it.
class LoadWatcher {
 public:
  // Called on the watcher's thread with each robot of each frame that arrives. May be empty.
  using OnRobot =
      std::function<void(const RobotId& robot, std::int64_t applied_sequence, absl::Time arrival)>;

  LoadWatcher(const std::string& target, const MissionId& mission, OnRobot on_robot);
  ~LoadWatcher();
  LoadWatcher(const LoadWatcher&) = delete;
  LoadWatcher& operator=(const LoadWatcher&) = delete;

  std::int64_t frame_count() const { return frames_; }
  // Whether the server ended the stream.
  bool was_sent_away() const { return sent_away_; }

 private:
  struct Call;

  void Run();

  const OnRobot on_robot_;
  const std::unique_ptr<Call> call_;
  std::atomic<std::int64_t> frames_ = 0;
  std::atomic<bool> sent_away_ = false;
  std::thread thread_;
};

}  // namespace plumescout::lab
