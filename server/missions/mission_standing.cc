// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_standing.h"

#include <utility>

#include "core/mission/conduct/conduct_errors.h"

namespace plumescout::server {

MissionStanding::MissionStanding(MissionId id, SteadyClock clock)
    : id_(std::move(id)), clock_(std::move(clock)), last_use_(clock_()) {}

MissionState MissionStanding::state() const {
  absl::MutexLock lock(&mutex_);
  return state_;
}

absl::Status MissionStanding::Pause() { return Enter(MissionState::kPaused); }

absl::Status MissionStanding::Resume() { return Enter(MissionState::kRunning); }

absl::Status MissionStanding::Enter(MissionState state) {
  absl::MutexLock lock(&mutex_);
  if (state_ == MissionState::kFinished) return MissionFinished(id_);
  state_ = state;
  return absl::OkStatus();
}

void MissionStanding::Finish() {
  absl::MutexLock lock(&mutex_);
  state_ = MissionState::kFinished;
}

absl::Status MissionStanding::CheckMayWrite() const {
  return state() == MissionState::kFinished ? MissionFinished(id_) : absl::OkStatus();
}

absl::Status MissionStanding::CheckMayPlan() const {
  return state() == MissionState::kPaused ? MissionPaused(id_) : CheckMayWrite();
}

absl::Duration MissionStanding::idle_time_to_live() const {
  absl::MutexLock lock(&mutex_);
  return idle_time_to_live_;
}

void MissionStanding::set_idle_time_to_live(absl::Duration duration) {
  absl::MutexLock lock(&mutex_);
  idle_time_to_live_ = duration;
}

EventRetention MissionStanding::event_retention() const {
  absl::MutexLock lock(&mutex_);
  return event_retention_;
}

void MissionStanding::set_event_retention(EventRetention retention) {
  absl::MutexLock lock(&mutex_);
  event_retention_ = retention;
}

void MissionStanding::Restore(MissionState state, absl::Duration idle_time_to_live,
                              EventRetention retention) {
  absl::MutexLock lock(&mutex_);
  state_ = state;
  idle_time_to_live_ = idle_time_to_live;
  event_retention_ = retention;
}

void MissionStanding::Touch() {
  absl::MutexLock lock(&mutex_);
  last_use_ = clock_();
}

absl::Duration MissionStanding::idle_time() const {
  absl::MutexLock lock(&mutex_);
  return absl::FromChrono(clock_() - last_use_);
}

SteadyTime MissionStanding::forget_at() const {
  absl::MutexLock lock(&mutex_);
  return After(last_use_, idle_time_to_live_);
}

}  // namespace plumescout::server
