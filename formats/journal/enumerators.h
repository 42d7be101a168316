// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/event.h"

namespace plumescout {

// Whether a stored value is one of the enumerators; another is damage. Each switch names all of
// them, so that one more does not compile until it is added here.
constexpr bool IsEnumerator(MissionPhase phase) {
  switch (phase) {
    case MissionPhase::kExploring:
    case MissionPhase::kGasProbing:
    case MissionPhase::kFallback:
    case MissionPhase::kComplete:
    case MissionPhase::kReturning:
    case MissionPhase::kSurvey:
    case MissionPhase::kSampling:
      return true;
  }
  return false;
}
constexpr bool IsEnumerator(GoalKind kind) {
  switch (kind) {
    case GoalKind::kOccupancyFrontier:
    case GoalKind::kGasFrontier:
    case GoalKind::kRandomFreeSpace:
    case GoalKind::kHome:
    case GoalKind::kInformation:
    case GoalKind::kSite:
      return true;
  }
  return false;
}
constexpr bool IsEnumerator(PathSource source) {
  switch (source) {
    case PathSource::kTree:
    case PathSource::kGridGuard:
    case PathSource::kGridSearch:
      return true;
  }
  return false;
}
constexpr bool IsEnumerator(RejectionReason reason) {
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
      return true;
  }
  return false;
}
constexpr bool IsEnumerator(PlanEnd end) {
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
constexpr bool IsEnumerator(ProgressOutcome outcome) {
  switch (outcome) {
    case ProgressOutcome::kReached:
    case ProgressOutcome::kBlocked:
    case ProgressOutcome::kAborted:
      return true;
  }
  return false;
}

}  // namespace plumescout
