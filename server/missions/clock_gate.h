// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "absl/time/time.h"
#include "core/mission/conduct/ingest.h"
#include "core/types/ids.h"
#include "server/base/clock.h"

namespace plumescout::server {

// What becomes of samples whose clock runs ahead.
struct ClockGateOptions {
  // A sample this much ahead of the wall clock, and of all other robots, is ahead; 0: none is.
  absl::Duration max_lead = absl::Seconds(5);
  // It is taken with the time of its arrival rather than refused.
  bool stamp_by_arrival = false;
};

// Keeps a robot whose clock is wrong from dragging the time of its mission along: claims, set-aside
// goals and the age of readings go by the newest sample time. Samples of the past pass, for logs
// are sent late and simulations run at any time. What the gate does is seen in the events, so a
// replay needs no clock. Thread-compatible.
class ClockGate {
 public:
  ClockGate(ClockGateOptions options, WallClock wall_clock);

  // How times of a robot are taken whose batches say when they were sent.
  struct Mapped {
    std::int64_t offset_ns = 0;  // see RobotState::clock_offset_ns
    std::int64_t now_ns = 0;     // by the mission's clock, when the batch arrived
  };
  // Marks entries that are ahead as refused (CLOCK_AHEAD), or stamps them anew. A gap that is ahead
  // loses its time only, of which it says nothing anyway. Times that are mapped are compared with
  // the mission's clock alone: the other robots are no excuse.
  void Pass(const RobotId& robot, std::vector<IncomingObservation>& batch,
            const std::optional<Mapped>& mapped = std::nullopt);

 private:
  // The least number there is if no other robot has sent a sample.
  std::int64_t NewestOfOthers_ns(const RobotId& robot) const;

  const ClockGateOptions options_;
  const WallClock wall_clock_;
  // Sample that passed, by robot; no later than the wall clock allows by itself, or robots that are
  // wrong together would push each other on and on.
  std::map<RobotId, std::int64_t> newest_ns_;
};

}  // namespace plumescout::server
