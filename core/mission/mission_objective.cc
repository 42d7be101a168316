// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Of a mission: how far it has come with its objective.

#include "core/mission/mission.h"

#include <cmath>

#include "core/belief/objective_assessment.h"

namespace plumescout {
namespace {

constexpr std::int64_t kAssessmentPeriod_ns = 1'000'000'000;  // of sample time
constexpr double kNanosecondsPerSecond = 1e9;

}  // namespace

bool Mission::has_purpose() const {
  return options_->objective.kind != ObjectiveKind::kCompleteMap ||
         options_->objective.deadline_s > 0.0;
}

void Mission::AssessIfDue() {
  const bool is_without = options_->objective.kind == ObjectiveKind::kCompleteMap;
  if (is_without) return;
  const ObjectiveOptions& objective = options_->objective;
  const bool is_settled = progress_.verdict.IsSettled(objective, sample_time_ns_);
  if (IsConcluded(progress_.status) && is_settled) return;
  if (progress_.assessed_ns && sample_time_ns_ - *progress_.assessed_ns < kAssessmentPeriod_ns) {
    return;
  }
  progress_.assessed_ns = sample_time_ns_;
  ObjectiveStatus now = AssessObjective(*Snapshot());
  now.state = progress_.verdict.Take(now.state, objective, sample_time_ns_,
                                     fleet_.Phase() == MissionPhase::kComplete);
  now.since_ns = now.state == progress_.status.state ? progress_.status.since_ns : sample_time_ns_;
  progress_.status = now;
}

void Mission::NoteWhetherItGoesOn() {
  if (options_->objective.kind == ObjectiveKind::kCompleteMap) return;
  ObjectiveStatus& status = progress_.status;
  const bool is_over = fleet_.Phase() == MissionPhase::kComplete;
  const bool was_over = status.state == ObjectiveState::kCannotBeMet;
  if (IsConcluded(status) || is_over == was_over) return;
  const ObjectiveState pending = progress_.verdict.pending();
  const ObjectiveState end =
      pending == ObjectiveState::kPursued ? ObjectiveState::kCannotBeMet : pending;
  status.state = is_over ? end : ObjectiveState::kPursued;
  status.since_ns = sample_time_ns_;
}

std::optional<std::int64_t> Mission::Deadline_ns() const {
  if (options_->objective.deadline_s == 0.0 || !progress_.began_ns) return std::nullopt;
  return *progress_.began_ns + static_cast<std::int64_t>(std::llround(
                                   options_->objective.deadline_s * kNanosecondsPerSecond));
}

}  // namespace plumescout
