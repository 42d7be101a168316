// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/patient_attempt.h"

#include <grpcpp/alarm.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "server/base/errors.h"

namespace plumescout::server {
namespace {

// What has become known between an attempt and the wait for it is looked at, but not for ever.
constexpr int kMostLooks = 3;

// An attempt that waits. The registry keeps it meanwhile.
class PatientAttempt : public std::enable_shared_from_this<PatientAttempt> {
 public:
  PatientAttempt(MissionRegistry& registry, std::function<absl::Status()> attempt,
                 std::function<void(const absl::Status&)> over)
      : registry_(registry), attempt_(std::move(attempt)), over_(std::move(over)) {}
  ~PatientAttempt() { End(); }
  PatientAttempt(const PatientAttempt&) = delete;
  PatientAttempt& operator=(const PatientAttempt&) = delete;

  // `status`: of the attempt before.
  void Begin(SteadyTime until, absl::Status status) {
    alarm_.Set(std::chrono::system_clock::now() + (until - SteadyNow()),
               [weak = weak_from_this()](bool) {
                 if (const auto self = weak.lock()) self->GiveUp();
               });
    GoOn(std::move(status));
  }

 private:
  void GoOn(absl::Status status) {
    for (int looks = 0; looks < kMostLooks && !AwaitedMission(status).empty(); ++looks) {
      if (Wait(status)) return;
      status = attempt_();
    }
    over_(status);
  }

  // Whether somebody goes on from here, or has ended it.
  bool Wait(const absl::Status& status) {
    {
      absl::MutexLock lock(&mutex_);
      if (is_late_) return false;
      waits_ = true;
      last_ = status;
    }
    const auto place = registry_.AwaitAnswer(AwaitedMission(status), [self = shared_from_this()] {
      if (self->TakeTurn()) self->GoOn(self->attempt_());
    });
    if (place == 0) return !TakeTurn();
    bool is_late = false;
    {
      absl::MutexLock lock(&mutex_);
      place_ = place;
      is_late = is_late_;
    }
    if (is_late) registry_.StopAwaiting(place);
    return true;
  }

  // Of several who might go on one does.
  bool TakeTurn() {
    absl::MutexLock lock(&mutex_);
    return std::exchange(waits_, false);
  }

  void GiveUp() {
    RecoveryWaiters::Id place = 0;
    {
      absl::MutexLock lock(&mutex_);
      is_late_ = true;
      place = place_;
    }
    registry_.StopAwaiting(place);
    End();
  }

  void End() {
    if (TakeTurn()) over_(last_);
  }

  MissionRegistry& registry_;
  const std::function<absl::Status()> attempt_;
  const std::function<void(const absl::Status&)> over_;
  grpc::Alarm alarm_;

  absl::Mutex mutex_;
  bool waits_ ABSL_GUARDED_BY(mutex_) = false;
  bool is_late_ ABSL_GUARDED_BY(mutex_) = false;
  RecoveryWaiters::Id place_ ABSL_GUARDED_BY(mutex_) = 0;  // the last
  absl::Status last_;                                      // of who takes the turn, once it waits
};

}  // namespace

void AttemptPatiently(const ServiceContext& context, SteadyTime deadline,
                      std::function<absl::Status()> attempt,
                      std::function<void(const absl::Status&)> over) {
  absl::Status status = attempt();
  const SteadyTime until = std::min(After(SteadyNow(), context.limits.recovery_patience),
                                    After(deadline, -context.limits.deadline_margin));
  if (AwaitedMission(status).empty() || until <= SteadyNow()) return over(status);
  const auto patient =
      std::make_shared<PatientAttempt>(*context.registry, std::move(attempt), std::move(over));
  patient->Begin(until, std::move(status));
}

}  // namespace plumescout::server
