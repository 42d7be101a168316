// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumescout {

// By which offsets times of a robot's clock were taken as the mission's: clocks drift, and are set.
// What was taken by an earlier offset keeps its time, so whoever names it by the robot's clock
// means that one.
class ClockHistory {
 public:
  // An observation was taken at this time of the mission.
  void Take(std::int64_t time_ns) { latest_ns_ = std::max(latest_ns_, time_ns); }
  // Another offset than this is in force from now on. The oldest of very many are forgotten, and
  // the next one stands for them.
  void End(std::int64_t offset_ns) {
    if (latest_ns_ < 0) return;  // nothing was taken by it
    if (stretches_.size() == kMostStretches) stretches_.erase(stretches_.begin());
    stretches_.push_back({latest_ns_, offset_ns});
  }

  // The mission's time at which an observation of that time of the robot's clock was taken;
  // `offset_ns` is in force now. Times that the clock never showed, when it was set forward, are
  // those of the last observation before; of times that it showed twice, when it was set back, it
  // is the later one.
  std::int64_t MissionTime_ns(std::int64_t robot_ns, std::int64_t offset_ns) const {
    std::int64_t time_ns = robot_ns + offset_ns;
    for (auto stretch = stretches_.rbegin(); stretch != stretches_.rend(); ++stretch) {
      const std::int64_t before_ns = robot_ns + stretch->offset_ns;
      if (before_ns > stretch->end_ns) return std::max(time_ns, stretch->end_ns);
      if (time_ns - stretch->end_ns > kSetBack_ns) break;
      time_ns = before_ns;
    }
    return time_ns;
  }

  // See core/types/byte_archive.h.
  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self) {
    archive(self.latest_ns_, self.stretches_);
  }

 private:
  static constexpr std::size_t kMostStretches = 256;
  // A clock that comes to be behind by less was not set, but is known better.
  static constexpr std::int64_t kSetBack_ns = 1'000'000'000;

  struct Stretch {
    std::int64_t end_ns = 0;  // of the mission: the last observation that was taken by the offset
    std::int64_t offset_ns = 0;

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self) {
      archive(self.end_ns, self.offset_ns);
    }
  };

  std::int64_t latest_ns_ = -1;
  std::vector<Stretch> stretches_;  // by time
};

}  // namespace plumescout
