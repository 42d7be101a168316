// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/plan_names.h"

namespace plumescout::lab {

const char* NameOf(MissionPhase phase) {
  switch (phase) {
    case MissionPhase::kExploring:
      return "exploring";
    case MissionPhase::kGasProbing:
      return "gas probing";
    case MissionPhase::kFallback:
      return "fallback";
    case MissionPhase::kComplete:
      return "complete";
    case MissionPhase::kReturning:
      return "returning";
    case MissionPhase::kSurvey:
      return "survey";
    case MissionPhase::kSampling:
      return "sampling";
  }
  return "unknown";
}

const char* NameOf(GoalKind kind) {
  switch (kind) {
    case GoalKind::kOccupancyFrontier:
      return "occupancy frontier";
    case GoalKind::kGasFrontier:
      return "gas frontier";
    case GoalKind::kRandomFreeSpace:
      return "random place";
    case GoalKind::kInformation:
      return "information";
    case GoalKind::kHome:
      return "home";
    case GoalKind::kSite:
      return "sampling site";
    case GoalKind::kMakeWay:
      return "making way";
  }
  return "unknown";
}

const char* NameOf(RejectionReason reason) {
  switch (reason) {
    case RejectionReason::kUnreachable:
      return "unreachable";
    case RejectionReason::kTooSmall:
      return "too small";
    case RejectionReason::kSetAside:
      return "set aside";
    case RejectionReason::kClaimed:
      return "claimed by another robot";
    case RejectionReason::kNotDrawn:
      return "beyond max_goal_count";
    case RejectionReason::kTooClose:
      return "too close";
    case RejectionReason::kSearchStopped:
      return "search stopped";
    case RejectionReason::kOverDeadline:
      return "after the deadline";
    case RejectionReason::kOverBudget:
      return "over the travel budget";
    case RejectionReason::kKeptOut:
      return "in a keep-out area";
    case RejectionReason::kGone:
      return "gone";
    case RejectionReason::kTraffic:
      return "another robot in the way";
  }
  return "unknown";
}

const char* NameOf(PlanEnd end) {
  switch (end) {
    case PlanEnd::kAllGoalsReached:
      return "all goals reached";
    case PlanEnd::kQueueExhausted:
      return "queue exhausted";
    case PlanEnd::kStopped:
      return "stopped";
    case PlanEnd::kNoGoals:
      return "no goals";
    case PlanEnd::kMissionComplete:
      return "mission complete";
    case PlanEnd::kStartOccupied:
      return "start occupied";
    case PlanEnd::kAllGoalsRejected:
      return "all goals rejected";
  }
  return "unknown";
}

const char* NameOf(PathSource source) {
  switch (source) {
    case PathSource::kTree:
      return "tree";
    case PathSource::kGridGuard:
      return "grid guard";
    case PathSource::kGridSearch:
      return "grid search";
  }
  return "unknown";
}

}  // namespace plumescout::lab
