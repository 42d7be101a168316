// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "absl/status/status.h"

namespace plumescout::lab {

// When a source releases gas. Times are those of the scene: 0 at frame 0, negative in the warm-up
// before it. Default: always.
struct ReleaseSchedule {
  std::optional<double> start_s;  // none: since the warm-up began
  std::optional<double> end_s;    // none: for ever
  // From `start_s` on by turns: gas for `on_s`, none for `off_s`. Both or neither.
  std::optional<double> on_s;
  std::optional<double> off_s;

  friend bool operator==(const ReleaseSchedule&, const ReleaseSchedule&) = default;
};

// kInvalidArgument, naming the key and its value, unless all is finite, the end comes after the
// start, and turns are longer than 0 and have a start.
absl::Status Validate(const ReleaseSchedule& schedule);

// For how much of [from_s, to_s) a source releases. REQUIRES: a valid schedule.
double ReleasingTime_s(const ReleaseSchedule& schedule, double from_s, double to_s);

}  // namespace plumescout::lab
