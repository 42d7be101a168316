// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_journal.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

#include "absl/strings/str_cat.h"
#include "core/types/observation.h"
#include "formats/journal/event_codec.h"
#include "server/base/errors.h"

namespace plumescout::server {
namespace {

constexpr std::size_t kMostRecordsAtOnce = 200;

}  // namespace

MissionJournal::MissionJournal(JournalHome home)
    : home_(std::move(home)),
      is_durable_(home_.store != nullptr && home_.store->is_durable()),
      durable_revision_(home_.head),
      flushed_revision_(home_.head) {}

std::int64_t MissionJournal::Add(const Event& event) {
  if (home_.store == nullptr) return 0;
  if (const auto* received = std::get_if<ObservationReceived>(&event.body)) {
    NoteObservation(event.number, *received);
  }
  records_.push_back(EncodeEvent(event, PlanDetail::kForReplay));
  const auto bytes = static_cast<std::int64_t>(records_.back().size());
  if (records_.size() >= kMostRecordsAtOnce) Flush();
  return bytes;
}

void MissionJournal::NoteObservation(std::int64_t number, const ObservationReceived& received) {
  const std::int64_t sequence = LastSequence(received.observation);
  absl::MutexLock lock(&mutex_);
  // Those that leave together become durable together.
  const bool joins = !marks_.empty() && marks_.back().robot == received.robot &&
                     marks_.back().number > flushed_revision_;
  if (joins) {
    marks_.back().number = number;
    marks_.back().sequence = sequence;
    return;
  }
  LogEnd& log = logs_[received.robot];
  if (log.marks++ == 0) log.durable_sequence = received.observation.sequence - 1;
  marks_.push_back({number, received.robot, sequence});
}

void MissionJournal::FlushIfIdle() {
  if (events_in_flight_ == 0) Flush();
}

void MissionJournal::Flush() {
  if (records_.empty()) return;
  {
    absl::MutexLock lock(&mutex_);
    ++in_flight_;
  }
  ++events_in_flight_;
  const std::int64_t first = flushed_revision_ + 1;
  flushed_revision_ += static_cast<std::int64_t>(records_.size());
  home_.store->Append(home_.key, home_.epoch, first, std::exchange(records_, {}),
                      [self = shared_from_this(), last = flushed_revision_](
                          const absl::Status& status) { self->EventsStored(last, status); });
}

void MissionJournal::PutStanding(std::string standing) {
  if (home_.store == nullptr) return;
  std::int64_t number = 0;
  {
    absl::MutexLock lock(&mutex_);
    ++in_flight_;
    number = ++last_standing_;
  }
  home_.store->PutStanding(home_.key, home_.epoch, std::move(standing),
                           [self = shared_from_this(), number](const absl::Status& status) {
                             self->StandingStored(number, status);
                           });
}

void MissionJournal::PutSnapshot(StoredSnapshot snapshot, Callback done) {
  if (home_.store == nullptr) return done(absl::OkStatus());
  home_.store->PutSnapshot(
      home_.key, home_.epoch, std::move(snapshot),
      [self = shared_from_this(), done = std::move(done)](const absl::Status& status) {
        if (!status.ok() || !self->trims_) return done(status);
        self->home_.store->Trim(self->home_.key, self->home_.epoch, done);
      });
}

void MissionJournal::EventsStored(std::int64_t last, const absl::Status& status) {
  if (status.ok()) {
    absl::MutexLock lock(&mutex_);
    durable_revision_ = last;
    PassMarks(last);
  }
  --events_in_flight_;
  Settle(status);
}

void MissionJournal::StandingStored(std::int64_t standing, const absl::Status& status) {
  if (status.ok()) {
    absl::MutexLock lock(&mutex_);
    durable_standing_ = std::max(durable_standing_, standing);
  }
  Settle(status);
}

void MissionJournal::PassMarks(std::int64_t last) {
  while (!marks_.empty() && marks_.front().number <= last) {
    LogEnd& log = logs_[marks_.front().robot];
    log.durable_sequence = marks_.front().sequence;
    --log.marks;
    marks_.pop_front();
  }
}

void MissionJournal::Settle(const absl::Status& status) {
  std::vector<Waiter> told;
  Callback when_lost;
  {
    absl::MutexLock lock(&mutex_);
    --in_flight_;
    if (status.ok()) {
      told = TakeWaiters([this](const Waiter& waiter) {
        mutex_.AssertHeld();
        return IsKept(waiter.revision, waiter.standing);
      });
    } else if (lost_.ok()) {
      lost_ = status;
      told.swap(waiters_);
      when_lost.swap(when_lost_);
    }
  }
  for (const Waiter& waiter : told) waiter.done(status);
  if (when_lost) when_lost(status);
}

std::vector<MissionJournal::Waiter> MissionJournal::TakeWaiters(
    const std::function<bool(const Waiter&)>& wanted) {
  const auto taken = std::stable_partition(waiters_.begin(), waiters_.end(),
                                           [&](const Waiter& waiter) { return !wanted(waiter); });
  std::vector<Waiter> waiters(std::make_move_iterator(taken),
                              std::make_move_iterator(waiters_.end()));
  waiters_.erase(taken, waiters_.end());
  return waiters;
}

std::int64_t MissionJournal::DurableSequence(const RobotId& robot,
                                             std::int64_t applied_sequence) const {
  if (!is_durable_) return 0;
  absl::MutexLock lock(&mutex_);
  const auto log = logs_.find(robot);
  if (log == logs_.end() || log->second.marks == 0) return applied_sequence;
  return std::min(applied_sequence, log->second.durable_sequence);
}

void MissionJournal::WhenDurable(std::int64_t revision, SteadyTime deadline, Callback done) {
  if (!is_durable_) return done(absl::OkStatus());
  absl::Status status;
  {
    absl::MutexLock lock(&mutex_);
    if (!IsKept(revision, last_standing_)) {
      status = lost_.ok() ? closed_ : lost_;
      if (status.ok()) {
        waiters_.push_back({revision, last_standing_, deadline, std::move(done)});
        return;
      }
    }
  }
  done(status);
}

SteadyTime MissionJournal::next_deadline() const {
  SteadyTime next = SteadyTime::max();
  absl::MutexLock lock(&mutex_);
  for (const Waiter& waiter : waiters_) next = std::min(next, waiter.deadline);
  return next;
}

void MissionJournal::DropOverdue(SteadyTime now) {
  std::vector<Waiter> overdue;
  {
    absl::MutexLock lock(&mutex_);
    overdue = TakeWaiters([now](const Waiter& waiter) { return waiter.deadline <= now; });
  }
  if (overdue.empty()) return;
  const absl::Status status =
      StoreTakesNothing("what was asked for is done, but it is not durable yet");
  for (const Waiter& waiter : overdue) waiter.done(status);
}

absl::Status MissionJournal::CheckTakesMore() const {
  if (!is_durable_) return absl::OkStatus();
  {
    absl::MutexLock lock(&mutex_);
    if (!lost_.ok()) return lost_;
  }
  const StoreState state = home_.store->state();
  if (!state.status.ok()) return StoreTakesNothing(state.status.message());
  if (state.backlog_bytes <= home_.max_backlog_bytes) return absl::OkStatus();
  return StoreTakesNothing(absl::StrCat(state.backlog_bytes, " bytes wait for the disk, more than ",
                                        "store.max_backlog_bytes = ", home_.max_backlog_bytes));
}

int MissionJournal::WindowNow(int window) const {
  if (!is_durable_) return window;
  // Whole up to half of the backlog, then less and less.
  const double share = 2.0 * (1.0 - static_cast<double>(home_.store->state().backlog_bytes) /
                                        static_cast<double>(home_.max_backlog_bytes));
  return std::clamp(static_cast<int>(share * window), 1, window);
}

void MissionJournal::WhenLost(Callback lost) {
  absl::Status status;
  {
    absl::MutexLock lock(&mutex_);
    status = lost_;
    if (status.ok()) {
      when_lost_ = std::move(lost);
      return;
    }
  }
  lost(status);
}

void MissionJournal::Close(const absl::Status& status) {
  std::vector<Waiter> told;
  {
    absl::MutexLock lock(&mutex_);
    if (closed_.ok()) closed_ = status;
    told.swap(waiters_);
    when_lost_ = nullptr;
  }
  for (const Waiter& waiter : told) waiter.done(status);
}

bool MissionJournal::AwaitStored(SteadyTime deadline) {
  absl::MutexLock lock(&mutex_);
  const absl::Condition stored(this, &MissionJournal::IsStored);
  if (deadline == SteadyTime::max()) {
    mutex_.Await(stored);
    return true;
  }
  return mutex_.AwaitWithTimeout(stored, absl::FromChrono(deadline - SteadyNow()));
}

void MissionJournal::Remove(Callback done) {
  if (home_.store == nullptr) return done(absl::OkStatus());
  home_.store->Remove(home_.key, home_.epoch, std::move(done));
}

}  // namespace plumescout::server
