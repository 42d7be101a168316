// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/event.h"
#include "core/types/visit_types.h"

namespace plumescout {

// As in core/types/visit_types.h, of the enumerations that only journals hold.
constexpr bool IsOne(PathSource source) {
  switch (source) {
    case PathSource::kTree:
    case PathSource::kGridGuard:
    case PathSource::kGridSearch:
      return true;
  }
  return false;
}
constexpr bool IsOne(RejectionReason reason) {
  switch (reason) {
    case RejectionReason::kUnreachable:
    case RejectionReason::kTooSmall:
    case RejectionReason::kSetAside:
    case RejectionReason::kClaimed:
    case RejectionReason::kNotDrawn:
    case RejectionReason::kTooClose:
    case RejectionReason::kSearchStopped:
    case RejectionReason::kOverBudget:
    case RejectionReason::kKeptOut:
    case RejectionReason::kGone:
    case RejectionReason::kTraffic:
    case RejectionReason::kOverDeadline:
      return true;
  }
  return false;
}
constexpr bool IsOne(PlanEnd end) {
  switch (end) {
    case PlanEnd::kAllGoalsReached:
    case PlanEnd::kQueueExhausted:
    case PlanEnd::kStopped:
    case PlanEnd::kNoGoals:
    case PlanEnd::kMissionComplete:
    case PlanEnd::kStartOccupied:
    case PlanEnd::kAllGoalsRejected:
      return true;
  }
  return false;
}
constexpr bool IsOne(ProgressOutcome outcome) {
  switch (outcome) {
    case ProgressOutcome::kReached:
    case ProgressOutcome::kBlocked:
    case ProgressOutcome::kAborted:
      return true;
  }
  return false;
}

}  // namespace plumescout
