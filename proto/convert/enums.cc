// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/enums.h"

#include "absl/strings/str_cat.h"
#include "proto/convert/field.h"

namespace plumescout {
namespace {

template <typename Core, typename Proto>
struct Row {
  Core core;
  Proto proto;
};

// Every enum is one table, read both ways.
constexpr Row<MissionPhase, v1::MissionPhase> kPhases[] = {
    {MissionPhase::kExploring, v1::MISSION_PHASE_EXPLORING},
    {MissionPhase::kGasProbing, v1::MISSION_PHASE_GAS_PROBING},
    {MissionPhase::kFallback, v1::MISSION_PHASE_FALLBACK},
    {MissionPhase::kComplete, v1::MISSION_PHASE_COMPLETE},
    {MissionPhase::kReturning, v1::MISSION_PHASE_RETURNING},
    {MissionPhase::kSurvey, v1::MISSION_PHASE_SURVEY},
    {MissionPhase::kSampling, v1::MISSION_PHASE_SAMPLING},
};
constexpr Row<GoalKind, v1::GoalKind> kGoalKinds[] = {
    {GoalKind::kOccupancyFrontier, v1::GOAL_KIND_OCCUPANCY_FRONTIER},
    {GoalKind::kGasFrontier, v1::GOAL_KIND_GAS_FRONTIER},
    {GoalKind::kRandomFreeSpace, v1::GOAL_KIND_RANDOM_FREE_SPACE},
    {GoalKind::kHome, v1::GOAL_KIND_HOME},
    {GoalKind::kInformation, v1::GOAL_KIND_INFORMATION},
    {GoalKind::kSite, v1::GOAL_KIND_SITE},
    {GoalKind::kMakeWay, v1::GOAL_KIND_MAKE_WAY},
};
constexpr Row<FrontierKind, v1::GoalKind> kFrontierKinds[] = {
    {FrontierKind::kOccupancy, v1::GOAL_KIND_OCCUPANCY_FRONTIER},
    {FrontierKind::kGas, v1::GOAL_KIND_GAS_FRONTIER},
};
constexpr Row<PathSource, v1::Candidate::PathSource> kPathSources[] = {
    {PathSource::kTree, v1::Candidate::PATH_SOURCE_TREE},
    {PathSource::kGridGuard, v1::Candidate::PATH_SOURCE_GRID_GUARD},
    {PathSource::kGridSearch, v1::Candidate::PATH_SOURCE_GRID_SEARCH},
};
constexpr Row<RejectionReason, v1::RejectedGoal::Reason> kRejectionReasons[] = {
    {RejectionReason::kUnreachable, v1::RejectedGoal::REASON_UNREACHABLE},
    {RejectionReason::kTooSmall, v1::RejectedGoal::REASON_TOO_SMALL},
    {RejectionReason::kSetAside, v1::RejectedGoal::REASON_SET_ASIDE},
    {RejectionReason::kClaimed, v1::RejectedGoal::REASON_CLAIMED},
    {RejectionReason::kNotDrawn, v1::RejectedGoal::REASON_NOT_DRAWN},
    {RejectionReason::kTooClose, v1::RejectedGoal::REASON_TOO_CLOSE},
    {RejectionReason::kSearchStopped, v1::RejectedGoal::REASON_SEARCH_STOPPED},
    {RejectionReason::kOverBudget, v1::RejectedGoal::REASON_OVER_BUDGET},
    {RejectionReason::kKeptOut, v1::RejectedGoal::REASON_KEPT_OUT},
    {RejectionReason::kGone, v1::RejectedGoal::REASON_GONE},
    {RejectionReason::kTraffic, v1::RejectedGoal::REASON_TRAFFIC},
    {RejectionReason::kOverDeadline, v1::RejectedGoal::REASON_OVER_DEADLINE},
};
constexpr Row<InvalidationReason, v1::PlanInvalidated::Reason> kInvalidationReasons[] = {
    {InvalidationReason::kMeetsRobot, v1::PlanInvalidated::REASON_MEETS_ROBOT},
    {InvalidationReason::kWayBlocked, v1::PlanInvalidated::REASON_WAY_BLOCKED},
    {InvalidationReason::kKeptOut, v1::PlanInvalidated::REASON_KEPT_OUT},
    {InvalidationReason::kSuperseded, v1::PlanInvalidated::REASON_SUPERSEDED},
    {InvalidationReason::kLapsed, v1::PlanInvalidated::REASON_LAPSED},
};
constexpr Row<std::optional<CellState>, v1::CellState> kCellStates[] = {
    {CellState::kUnknown, v1::CELL_STATE_UNKNOWN},
    {CellState::kFree, v1::CELL_STATE_FREE},
    {CellState::kOccupied, v1::CELL_STATE_OCCUPIED},
    {std::nullopt, v1::CELL_STATE_OFF_MAP},
};
constexpr Row<PlanEnd, v1::Plan::End> kPlanEnds[] = {
    {PlanEnd::kAllGoalsReached, v1::Plan::END_ALL_GOALS_REACHED},
    {PlanEnd::kQueueExhausted, v1::Plan::END_QUEUE_EXHAUSTED},
    {PlanEnd::kStopped, v1::Plan::END_STOPPED},
    {PlanEnd::kNoGoals, v1::Plan::END_NO_GOALS},
    {PlanEnd::kMissionComplete, v1::Plan::END_MISSION_COMPLETE},
    {PlanEnd::kStartOccupied, v1::Plan::END_START_OCCUPIED},
    {PlanEnd::kAllGoalsRejected, v1::Plan::END_ALL_GOALS_REJECTED},
};
constexpr Row<ProgressOutcome, v1::ReportProgressRequest::Outcome> kOutcomes[] = {
    {ProgressOutcome::kReached, v1::ReportProgressRequest::OUTCOME_REACHED},
    {ProgressOutcome::kBlocked, v1::ReportProgressRequest::OUTCOME_BLOCKED},
    {ProgressOutcome::kAborted, v1::ReportProgressRequest::OUTCOME_ABORTED},
};
constexpr Row<GasScale, v1::GasScale> kGasScales[] = {
    {GasScale::kLinear, v1::GAS_SCALE_LINEAR},
    {GasScale::kSquareRoot, v1::GAS_SCALE_SQUARE_ROOT},
};
constexpr Row<GasPrecisions, v1::GasPrecisions> kGasPrecisions[] = {
    {GasPrecisions::kFixed, v1::GAS_PRECISIONS_FIXED},
    {GasPrecisions::kLearned, v1::GAS_PRECISIONS_LEARNED},
};
constexpr Row<ObjectiveKind, v1::ObjectiveKind> kObjectiveKinds[] = {
    {ObjectiveKind::kCompleteMap, v1::OBJECTIVE_KIND_COMPLETE_MAP},
    {ObjectiveKind::kMapAboveThreshold, v1::OBJECTIVE_KIND_MAP_ABOVE_THRESHOLD},
    {ObjectiveKind::kConfirmClean, v1::OBJECTIVE_KIND_CONFIRM_CLEAN},
    {ObjectiveKind::kFindSources, v1::OBJECTIVE_KIND_FIND_SOURCES},
};
constexpr Row<ObjectiveState, v1::ObjectiveStatus::State> kObjectiveStates[] = {
    {ObjectiveState::kPursued, v1::ObjectiveStatus::STATE_PURSUED},
    {ObjectiveState::kMet, v1::ObjectiveStatus::STATE_MET},
    {ObjectiveState::kRefuted, v1::ObjectiveStatus::STATE_REFUTED},
    {ObjectiveState::kCannotBeMet, v1::ObjectiveStatus::STATE_CANNOT_BE_MET},
};

constexpr Row<WgfdScope, v1::WgfdScope> kWgfdScopes[] = {
    {WgfdScope::kReachable, v1::WGFD_SCOPE_REACHABLE},
    {WgfdScope::kLocal, v1::WGFD_SCOPE_LOCAL},
};
constexpr Row<GoalPolicy, v1::GoalPolicy> kGoalPolicies[] = {
    {GoalPolicy::kGasFirst, v1::GOAL_POLICY_GAS_FIRST},
    {GoalPolicy::kOccupancyFirst, v1::GOAL_POLICY_OCCUPANCY_FIRST},
    {GoalPolicy::kOccupancyOnly, v1::GOAL_POLICY_OCCUPANCY_ONLY},
    {GoalPolicy::kEverything, v1::GOAL_POLICY_EVERYTHING},
};
constexpr Row<CostKind, v1::CostKind> kCostKinds[] = {
    {CostKind::kUcb, v1::COST_KIND_UCB},
    {CostKind::kEuclidean, v1::COST_KIND_EUCLIDEAN},
    {CostKind::kVertices, v1::COST_KIND_VERTICES},
};
constexpr Row<SamplingKind, v1::SamplingKind> kSamplingKinds[] = {
    {SamplingKind::kSystematic, v1::SAMPLING_KIND_SYSTEMATIC},
    {SamplingKind::kIid, v1::SAMPLING_KIND_IID},
};
constexpr Row<SelectionRule, v1::SelectionRule> kSelectionRules[] = {
    {SelectionRule::kLeastCost, v1::SELECTION_RULE_LEAST_COST},
    {SelectionRule::kMeanUcb, v1::SELECTION_RULE_MEAN_UCB},
    {SelectionRule::kInformationRate, v1::SELECTION_RULE_INFORMATION_RATE},
};
constexpr Row<SamplingReward, v1::SamplingReward> kSamplingRewards[] = {
    {SamplingReward::kVariance, v1::SAMPLING_REWARD_VARIANCE},
    {SamplingReward::kVariancePerTime, v1::SAMPLING_REWARD_VARIANCE_PER_TIME},
    {SamplingReward::kConcentrationVariance, v1::SAMPLING_REWARD_CONCENTRATION_VARIANCE},
    {SamplingReward::kConcentrationPerTime, v1::SAMPLING_REWARD_CONCENTRATION_PER_TIME},
    {SamplingReward::kConcentrationVariancePerTime,
     v1::SAMPLING_REWARD_CONCENTRATION_VARIANCE_PER_TIME},
    {SamplingReward::kMean, v1::SAMPLING_REWARD_MEAN},
    {SamplingReward::kUcb, v1::SAMPLING_REWARD_UCB},
};
constexpr Row<PathKind, v1::PathKind> kPathKinds[] = {
    {PathKind::kXit, v1::PATH_KIND_XIT},
    {PathKind::kAnytimeXit, v1::PATH_KIND_ANYTIME_XIT},
    {PathKind::kGridExact, v1::PATH_KIND_GRID_EXACT},
    {PathKind::kRrt, v1::PATH_KIND_RRT},
    {PathKind::kRrtStar, v1::PATH_KIND_RRT_STAR},
    {PathKind::kInformedRrtStar, v1::PATH_KIND_INFORMED_RRT_STAR},
    {PathKind::kBitStar, v1::PATH_KIND_BIT_STAR},
    {PathKind::kPrmStar, v1::PATH_KIND_PRM_STAR},
};

// Proto's zero, "unspecified", if the table lacks the value.
template <typename Core, typename Proto, std::size_t N>
Proto Find(const Row<Core, Proto> (&table)[N], Core value) {
  for (const auto& row : table) {
    if (row.core == value) return row.proto;
  }
  return Proto{};
}

template <typename Core, typename Proto, std::size_t N>
absl::StatusOr<Core> Find(const Row<Core, Proto> (&table)[N], Proto value,
                          absl::string_view field) {
  for (const auto& row : table) {
    if (row.proto == value) return row.core;
  }
  const int number = static_cast<int>(value);
  if (number == 0) return FieldError(field, "must be set");
  return FieldError(field, static_cast<double>(number), "is not a value of this field");
}

}  // namespace

v1::MissionPhase ToProto(MissionPhase value) { return Find(kPhases, value); }
v1::GoalKind ToProto(GoalKind value) { return Find(kGoalKinds, value); }
v1::GoalKind ToProto(FrontierKind value) { return Find(kFrontierKinds, value); }
v1::Candidate::PathSource ToProto(PathSource value) { return Find(kPathSources, value); }
v1::RejectedGoal::Reason ToProto(RejectionReason value) { return Find(kRejectionReasons, value); }
v1::Plan::End ToProto(PlanEnd value) { return Find(kPlanEnds, value); }
v1::PlanInvalidated::Reason ToProto(InvalidationReason value) {
  return Find(kInvalidationReasons, value);
}
v1::ReportProgressRequest::Outcome ToProto(ProgressOutcome value) { return Find(kOutcomes, value); }
v1::GasScale ToProto(GasScale value) { return Find(kGasScales, value); }
v1::GasPrecisions ToProto(GasPrecisions value) { return Find(kGasPrecisions, value); }
v1::ObjectiveKind ToProto(ObjectiveKind value) { return Find(kObjectiveKinds, value); }
v1::ObjectiveStatus::State ToProto(ObjectiveState value) { return Find(kObjectiveStates, value); }
v1::WgfdScope ToProto(WgfdScope value) { return Find(kWgfdScopes, value); }
v1::GoalPolicy ToProto(GoalPolicy value) { return Find(kGoalPolicies, value); }
v1::CostKind ToProto(CostKind value) { return Find(kCostKinds, value); }
v1::SamplingKind ToProto(SamplingKind value) { return Find(kSamplingKinds, value); }
v1::SelectionRule ToProto(SelectionRule value) { return Find(kSelectionRules, value); }
v1::SamplingReward ToProto(SamplingReward value) { return Find(kSamplingRewards, value); }
v1::PathKind ToProto(PathKind value) { return Find(kPathKinds, value); }
v1::CellState ToProto(std::optional<CellState> value) { return Find(kCellStates, value); }

absl::StatusOr<MissionPhase> FromProto(v1::MissionPhase proto, absl::string_view field) {
  return Find(kPhases, proto, field);
}
absl::StatusOr<GoalKind> FromProto(v1::GoalKind proto, absl::string_view field) {
  return Find(kGoalKinds, proto, field);
}
absl::StatusOr<FrontierKind> FrontierKindFromProto(v1::GoalKind proto, absl::string_view field) {
  return Find(kFrontierKinds, proto, field);
}
absl::StatusOr<PathSource> FromProto(v1::Candidate::PathSource proto, absl::string_view field) {
  return Find(kPathSources, proto, field);
}
absl::StatusOr<RejectionReason> FromProto(v1::RejectedGoal::Reason proto, absl::string_view field) {
  return Find(kRejectionReasons, proto, field);
}
absl::StatusOr<PlanEnd> FromProto(v1::Plan::End proto, absl::string_view field) {
  return Find(kPlanEnds, proto, field);
}
absl::StatusOr<InvalidationReason> FromProto(v1::PlanInvalidated::Reason proto,
                                             absl::string_view field) {
  return Find(kInvalidationReasons, proto, field);
}
absl::StatusOr<ProgressOutcome> FromProto(v1::ReportProgressRequest::Outcome proto,
                                          absl::string_view field) {
  return Find(kOutcomes, proto, field);
}
absl::StatusOr<GasScale> FromProto(v1::GasScale proto, absl::string_view field) {
  return Find(kGasScales, proto, field);
}
absl::StatusOr<GasPrecisions> FromProto(v1::GasPrecisions proto, absl::string_view field) {
  return Find(kGasPrecisions, proto, field);
}
absl::StatusOr<ObjectiveKind> FromProto(v1::ObjectiveKind proto, absl::string_view field) {
  return Find(kObjectiveKinds, proto, field);
}
absl::StatusOr<ObjectiveState> FromProto(v1::ObjectiveStatus::State proto,
                                         absl::string_view field) {
  return Find(kObjectiveStates, proto, field);
}
absl::StatusOr<WgfdScope> FromProto(v1::WgfdScope proto, absl::string_view field) {
  return Find(kWgfdScopes, proto, field);
}
absl::StatusOr<GoalPolicy> FromProto(v1::GoalPolicy proto, absl::string_view field) {
  return Find(kGoalPolicies, proto, field);
}
absl::StatusOr<CostKind> FromProto(v1::CostKind proto, absl::string_view field) {
  return Find(kCostKinds, proto, field);
}
absl::StatusOr<SamplingKind> FromProto(v1::SamplingKind proto, absl::string_view field) {
  return Find(kSamplingKinds, proto, field);
}
absl::StatusOr<SelectionRule> FromProto(v1::SelectionRule proto, absl::string_view field) {
  return Find(kSelectionRules, proto, field);
}
absl::StatusOr<SamplingReward> FromProto(v1::SamplingReward proto, absl::string_view field) {
  return Find(kSamplingRewards, proto, field);
}
absl::StatusOr<PathKind> FromProto(v1::PathKind proto, absl::string_view field) {
  return Find(kPathKinds, proto, field);
}
absl::StatusOr<std::optional<CellState>> FromProto(v1::CellState proto, absl::string_view field) {
  return Find(kCellStates, proto, field);
}

}  // namespace plumescout
