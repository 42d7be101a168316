// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/held_verdict.h"

#include <cmath>

namespace plumescout {
namespace {

bool HasToHold(ObjectiveKind kind, ObjectiveState state) {
  return state == ObjectiveState::kMet ||
         (state == ObjectiveState::kRefuted && kind == ObjectiveKind::kFindSources);
}

}  // namespace

ObjectiveState HeldVerdict::Take(ObjectiveState state, const ObjectiveOptions& objective,
                                 std::int64_t now_ns, bool nothing_left_to_do) {
  if (objective.hold_s == 0.0) return state;
  const ObjectiveState verdict =
      HasToHold(objective.kind, state) ? state : ObjectiveState::kPursued;
  if (verdict != state_) {
    state_ = verdict;
    since_ns_ = now_ns;
  }
  const bool waits = !nothing_left_to_do && !IsSettled(objective, now_ns);
  return waits ? ObjectiveState::kPursued : state;
}

bool HeldVerdict::IsSettled(const ObjectiveOptions& objective, std::int64_t now_ns) const {
  constexpr double kNanosecondsPerSecond = 1e9;
  return state_ == ObjectiveState::kPursued ||
         now_ns - since_ns_ >= std::llround(objective.hold_s * kNanosecondsPerSecond);
}

}  // namespace plumescout
