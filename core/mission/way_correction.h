// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/types/observation.h"
#include "core/types/pose2.h"

namespace plumescout {

// Where a robot held itself to be.
struct WayPoint {
  std::int64_t time_ns = 0;
  Pose2 pose;
};

// Moves a way so that it passes through anchors: rigidly before the first and after the last; in
// between what the two neighbours would make of a pose is blended by time, so that the way bends
// and does not break, and the result does not depend on where the origin of the frame lies.
class WayCorrection {
 public:
  // REQUIRES: `way` in order of time, not empty; anchors in the same frame, in order, not empty.
  // Cost: O((way + anchors) log).
  WayCorrection(const std::vector<WayPoint>& way, const std::vector<PoseAnchor>& anchors);

  // Of a pose of the way at that time. Cost: O(log anchors).
  Pose2 Corrected(std::int64_t time_ns, const Pose2& pose) const;

 private:
  struct Move {
    std::int64_t time_ns = 0;
    Pose2 held;
    Pose2 right;

    Pose2 Of(const Pose2& pose) const;
  };

  std::vector<Move> moves_;
};

// Between neighbours by time; at its ends the way stands still. REQUIRES: `way` in order, not
// empty.
Pose2 PoseOnWay(const std::vector<WayPoint>& way, std::int64_t time_ns);

}  // namespace plumescout
