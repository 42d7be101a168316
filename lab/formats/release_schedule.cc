// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/release_schedule.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

constexpr double kMaxTime_s = 1e6;  // more than a week: no scene lasts that long

// Releasing time of the first `elapsed_s` of turns.
double TurnsTime_s(double on_s, double off_s, double elapsed_s) {
  const double turns = std::floor(elapsed_s / (on_s + off_s));
  return turns * on_s + std::min(on_s, elapsed_s - turns * (on_s + off_s));
}

}  // namespace

absl::Status Validate(const ReleaseSchedule& schedule) {
  constexpr double kShortestTurn_s = 1e-3;  // far below a step of the simulation
  PLUMESCOUT_RETURN_IF_ERROR(
      Checker()
          .InRange("start_s", schedule.start_s.value_or(0.0), -kMaxTime_s, kMaxTime_s)
          .InRange("end_s", schedule.end_s.value_or(0.0), -kMaxTime_s, kMaxTime_s)
          .InRange("on_s", schedule.on_s.value_or(kMaxTime_s), kShortestTurn_s, kMaxTime_s)
          .InRange("off_s", schedule.off_s.value_or(kMaxTime_s), kShortestTurn_s, kMaxTime_s)
          .status());
  if (schedule.start_s && schedule.end_s && !(*schedule.end_s > *schedule.start_s)) {
    return absl::InvalidArgumentError(
        absl::StrCat("end_s = ", *schedule.end_s, " must be after start_s = ", *schedule.start_s));
  }
  if (schedule.on_s.has_value() != schedule.off_s.has_value()) {
    return absl::InvalidArgumentError("on_s and off_s must come together");
  }
  if (schedule.on_s && !schedule.start_s) {
    return absl::InvalidArgumentError("on_s and off_s must come with start_s");
  }
  return absl::OkStatus();
}

double ReleasingTime_s(const ReleaseSchedule& schedule, double from_s, double to_s) {
  const double first_s = std::max(from_s, schedule.start_s.value_or(from_s));
  const double last_s = std::min(to_s, schedule.end_s.value_or(to_s));
  if (!(last_s > first_s)) return 0.0;
  if (!schedule.on_s) return last_s - first_s;
  const double start_s = *schedule.start_s;
  return TurnsTime_s(*schedule.on_s, *schedule.off_s, last_s - start_s) -
         TurnsTime_s(*schedule.on_s, *schedule.off_s, first_s - start_s);
}

}  // namespace plumescout::lab
