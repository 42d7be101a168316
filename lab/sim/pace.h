// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "absl/status/status.h"
#include "core/types/rng.h"

namespace plumescout::lab {

// How far a robot that is placed on its path falls short of the path's times.
struct PaceOptions {
  // It is placed no faster than this on the whole, (0, 100]; none: as fast as the path wants it.
  std::optional<double> top_speed_mps = std::nullopt;
  double most_late_s = 0.0;  // a leg falls behind by up to this, drawn anew for each, [0, 60]

  friend bool operator==(const PaceOptions&, const PaceOptions&) = default;
};

// kInvalidArgument naming field, value and range.
absl::Status Validate(const PaceOptions& options);

// Says when a robot that follows its path exactly is not where the path's times would have it.
class Pace {
 public:
  // REQUIRES: valid options.
  Pace(const PaceOptions& options, std::uint64_t seed);

  // A leg has ended: by how much the next one will be late is drawn.
  void BeginLeg();
  // Whether the robot may be `move_m` farther on at `now_s`; if not, it stays where it is until it
  // is asked again. Times do not fall.
  bool MayMove(double move_m, double now_s);

 private:
  PaceOptions options_;
  Rng rng_;
  double late_s_ = 0.0;   // of this leg, in the end
  double held_s_ = 0.0;   // so far
  double asked_s_ = 0.0;  // when it last was
  double ready_s_ = 0.0;  // when the moves so far are done at the top speed
};

}  // namespace plumescout::lab
