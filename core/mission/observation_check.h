// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "absl/status/status.h"
#include "core/mission/way_correction.h"
#include "core/types/observation.h"
#include "core/types/options.h"
#include "core/types/pose2.h"

namespace plumescout {

// No clock that says a time since 1970 is farther off. Sample times and offsets stay below 2^62, so
// their sums stay within 64 bits.
inline constexpr std::int64_t kMaxClockOffset_ns = (std::int64_t{1} << 62) - 1;

// When the observation was made by the mission's time, if the robot's clock is so far behind that.
// What is no time after 1970 stays as it is; a gap was made at no time in particular.
std::int64_t MissionTime_ns(const Observation& observation, std::int64_t clock_offset_ns);

// Whether it tells when it was made: a gap need not, and then its time is 0.
bool SaysWhen(const Observation& observation);
// Whether it tells where the robot was: a gap and a status need not, and then have the origin of
// the robot's frame as their pose.
bool SaysWhere(const Observation& observation);

// OK if the mission can take the observation; otherwise kInvalidArgument naming field, value and
// limit. Single bad beams of a scan are no fault of the scan. `newest_sample_time_ns`: of the
// mission so far, 0 if none; a clock that leaps ahead of it by more than a day is refused, because
// ageing and expiry go by the newest sample time.
//
// `clock_offset_ns`: of the robot's clock, see RobotState. Limits are those of the mission's time;
// the field is named with the value that the robot gave.
absl::Status CheckObservation(const Observation& observation, const MissionOptions& options,
                              std::int64_t newest_sample_time_ns, std::int64_t clock_offset_ns = 0);

// kInvalidArgument if a pose lies beyond the limit in frame map, though not in its robot's frame.
absl::Status CheckPlace(const Pose2& in_mission, double limit_m);

// kInvalidArgument if the robot cannot have come from `before` to `now`, both in frame map: it is
// farther than 5 m and what it drives meanwhile at that speed; 0: it can. A jump of a few metres is
// no fault of the observation, see JumpWatch.
absl::Status CheckStep(const WayPoint& before, const WayPoint& now, double max_robot_speed_mps);

}  // namespace plumescout
