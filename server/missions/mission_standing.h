// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "core/types/ids.h"
#include "server/base/clock.h"

namespace plumescout::server {

enum class MissionState { kRunning, kPaused, kFinished };

// Which of a mission's events are kept: all, or what a recovery needs.
enum class EventRetention { kAll, kSinceSnapshot };

// What operators have done to a mission, apart from its events, and when somebody called for it
// last. Thread-safe.
class MissionStanding {
 public:
  MissionStanding(MissionId id, SteadyClock clock);

  MissionState state() const;
  // MISSION_FINISHED: what is finished stays so. No effect on a mission that is as they make it.
  absl::Status Pause();
  absl::Status Resume();
  void Finish();
  // MISSION_FINISHED.
  absl::Status CheckMayWrite() const;
  // MISSION_FINISHED, MISSION_PAUSED.
  absl::Status CheckMayPlan() const;

  // How long nobody need call for the mission before it may go; infinite: it may never.
  absl::Duration idle_time_to_live() const;
  void set_idle_time_to_live(absl::Duration duration);
  EventRetention event_retention() const;
  void set_event_retention(EventRetention retention);
  // As it was when the mission was recovered.
  void Restore(MissionState state, absl::Duration idle_time_to_live, EventRetention retention);
  // Somebody calls for it, or has it in use.
  void Touch();
  absl::Duration idle_time() const;
  // When it may go if nobody calls for it; max(): never.
  SteadyTime forget_at() const;
  bool has_outlived_its_use() const { return idle_time() >= idle_time_to_live(); }

 private:
  absl::Status Enter(MissionState state) ABSL_LOCKS_EXCLUDED(mutex_);

  const MissionId id_;
  const SteadyClock clock_;

  mutable absl::Mutex mutex_;
  MissionState state_ ABSL_GUARDED_BY(mutex_) = MissionState::kRunning;
  absl::Duration idle_time_to_live_ ABSL_GUARDED_BY(mutex_) = absl::InfiniteDuration();
  EventRetention event_retention_ ABSL_GUARDED_BY(mutex_) = EventRetention::kAll;
  SteadyTime last_use_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
