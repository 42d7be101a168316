// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"

namespace plumescout {

// A typed error is a status whose message begins with its reason, an UPPER_SNAKE word that programs
// may act on: "SEQUENCE_GAP: expected 7, got 9". Whatever carries the error keeps to this form, and
// on the wire the reason stands in an ErrorInfo as well.
namespace reason {

// Of the conduct of missions.
inline constexpr absl::string_view kMissionNotFound = "MISSION_NOT_FOUND";
inline constexpr absl::string_view kMissionExists = "MISSION_EXISTS";
inline constexpr absl::string_view kMissionPaused = "MISSION_PAUSED";
inline constexpr absl::string_view kMissionFinished = "MISSION_FINISHED";
inline constexpr absl::string_view kRobotNotFound = "ROBOT_NOT_FOUND";
inline constexpr absl::string_view kLeaseHeld = "LEASE_HELD";
inline constexpr absl::string_view kLeaseSuperseded = "LEASE_SUPERSEDED";
inline constexpr absl::string_view kStreamReplaced = "STREAM_REPLACED";
inline constexpr absl::string_view kCreditExceeded = "CREDIT_EXCEEDED";
inline constexpr absl::string_view kSequenceGap = "SEQUENCE_GAP";
inline constexpr absl::string_view kBudgetReached = "BUDGET_REACHED";
inline constexpr absl::string_view kClockAhead = "CLOCK_AHEAD";
inline constexpr absl::string_view kHistoryTrimmed = "HISTORY_TRIMMED";
inline constexpr absl::string_view kKeepOutAreaNotFound = "KEEP_OUT_AREA_NOT_FOUND";
inline constexpr absl::string_view kKeepOutAreaExists = "KEEP_OUT_AREA_EXISTS";
inline constexpr absl::string_view kKeepOutCoversHome = "KEEP_OUT_COVERS_HOME";
// Of plans.
inline constexpr absl::string_view kPlanSuperseded = "PLAN_SUPERSEDED";
inline constexpr absl::string_view kPlanEnded = "PLAN_ENDED";
inline constexpr absl::string_view kStartOutsideMap = "START_OUTSIDE_MAP";
inline constexpr absl::string_view kStartInRobot = "START_IN_ROBOT";
inline constexpr absl::string_view kTeamTooLarge = "TEAM_TOO_LARGE";
inline constexpr absl::string_view kOutsideRegion = "OUTSIDE_REGION";
inline constexpr absl::string_view kDeadlineBeforeFirstPlan = "DEADLINE_BEFORE_FIRST_PLAN";
// Of maps.
inline constexpr absl::string_view kMapPartsGone = "MAP_PARTS_GONE";
// Of a server that others load or restart.
inline constexpr absl::string_view kOverloaded = "OVERLOADED";
inline constexpr absl::string_view kLimitReached = "LIMIT_REACHED";
inline constexpr absl::string_view kRateExceeded = "RATE_EXCEEDED";
inline constexpr absl::string_view kDraining = "DRAINING";
inline constexpr absl::string_view kServerRestarted = "SERVER_RESTARTED";
// Of what outlives a server.
inline constexpr absl::string_view kStoreUnavailable = "STORE_UNAVAILABLE";
inline constexpr absl::string_view kStoreRolledBack = "STORE_ROLLED_BACK";
inline constexpr absl::string_view kStoreDamaged = "STORE_DAMAGED";
inline constexpr absl::string_view kRecovering = "RECOVERING";
inline constexpr absl::string_view kFenced = "FENCED";
inline constexpr absl::string_view kMissionElsewhere = "MISSION_ELSEWHERE";
inline constexpr absl::string_view kNodeUnreached = "NODE_UNREACHED";
inline constexpr absl::string_view kExportDamaged = "EXPORT_DAMAGED";

}  // namespace reason

// "REASON: message".
absl::Status TypedError(absl::StatusCode code, absl::string_view reason, absl::string_view message);

// The reason with which the message begins, or nothing.
absl::string_view ErrorReason(const absl::Status& status);

// The same error, which says not to try again before so long from now. A payload carries it.
absl::Status WithRetryAfter(absl::Status status, std::int64_t delay_ns);
std::optional<std::int64_t> RetryAfter_ns(const absl::Status& status);
// The same error as it was before WithRetryAfter.
absl::Status WithoutRetryAfter(absl::Status status);

}  // namespace plumescout
