// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "core/mission/conduct/ingest.h"
#include "core/types/ids.h"
#include "server/base/clock.h"
#include "server/missions/clock_estimator.h"

namespace plumescout::server {

// The time that the missions of a server live in: its wall clock when this was made, carried on by
// its steady clock. Who sets the wall clock meanwhile neither ages readings nor stops a mission.
// Thread-safe.
class MissionClock {
 public:
  MissionClock(const WallClock& wall_clock, SteadyClock steady_clock)
      : steady_clock_(std::move(steady_clock)), began_(steady_clock_()), began_ns_(wall_clock()) {}

  std::int64_t now_ns() const {
    return began_ns_ + absl::ToInt64Nanoseconds(absl::FromChrono(steady_clock_() - began_));
  }

 private:
  const SteadyClock steady_clock_;
  const SteadyTime began_;
  const std::int64_t began_ns_;
};

// When a batch was sent, by the robot's clock, and came, by the mission's.
struct BatchTimes {
  std::int64_t sent_ns = 0;  // 0: it does not say, and the others do not matter
  std::int64_t arrived_ns = 0;
  bool at_the_latest = false;  // it came then, or earlier and nobody read it
};

// What the batches of a robot told of its link, since the server began to run its mission.
struct LinkTimes {
  std::int64_t heard_ns = 0;  // when the latest batch was applied, by the mission's clock
  // Time of its newest sample, by the mission's clock; none unless batches say when they were sent.
  std::optional<std::int64_t> newest_sample_ns = std::nullopt;
  std::int64_t offset_ns = 0;  // see RobotState::clock_offset_ns
};

// The clocks and links of the robots of a mission. Thread-safe; estimates are the writer's.
class RobotClocks {
 public:
  // What to reckon with for a batch.
  struct Reckoning {
    std::int64_t offset_ns = 0;  // to put in force
    bool was_set = false;        // the robot's clock, since the batch before
  };
  // While `in_force_ns` is.
  Reckoning Reckon(const RobotId& robot, const BatchTimes& times, std::int64_t in_force_ns);
  // A batch was applied.
  void NoteBatch(const RobotId& robot, const LinkTimes& link);
  // The robot has left the mission: should it come back, its clock may be another.
  void Forget(const RobotId& robot);

  std::optional<LinkTimes> LinkOf(const RobotId& robot) const;
  // The farthest that a clock is off, either way.
  absl::Duration WorstOffset() const;

 private:
  std::map<RobotId, ClockEstimator> estimators_;  // of the writer

  mutable absl::Mutex mutex_;
  std::map<RobotId, LinkTimes> links_ ABSL_GUARDED_BY(mutex_);
};

// Takes those entries out of a batch, from its beginning, that were made before the robot's clock
// was set, by `moved_ns`: as far as its times leap, or lie after it was sent.
std::vector<IncomingObservation> TakeMadeBefore(std::int64_t moved_ns, std::int64_t sent_ns,
                                                std::vector<IncomingObservation>& batch);

}  // namespace plumescout::server
