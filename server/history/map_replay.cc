// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/map_replay.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <variant>

#include "core/mission/observation_check.h"
#include "core/types/status_macros.h"
#include "formats/journal/event_codec.h"

namespace plumescout::server {
namespace {

// A task ends after so much: others wait for the pool's thread.
constexpr int kMaxEventsAtOnce = 5000;
constexpr absl::Duration kMaxTimeAtOnce = absl::Milliseconds(100);
// Between looks at whether the next event is due.
constexpr absl::Duration kShortestWait = absl::Milliseconds(10);
constexpr absl::Duration kLongestWait = absl::Seconds(1);
// Where the pool has no room, it is asked again after this.
constexpr absl::Duration kPoolRetry = absl::Milliseconds(250);

}  // namespace

MapReplay::MapReplay(Parts parts, const ReplayWish& wish)
    : parts_(std::move(parts)),
      wish_(wish),
      map_store_(parts_.host->id(), parts_.host->map_feed()->store().max_part_bytes()) {}

absl::Status MapReplay::Begin(std::shared_ptr<MapReader> reader, std::function<void()> caught_up) {
  {
    absl::MutexLock lock(&mutex_);
    reader_ = std::move(reader);
    caught_up_ = std::move(caught_up);
  }
  return Queue(&MapReplay::Prepare);
}

void MapReplay::Await() {
  SteadyTime time;
  {
    absl::MutexLock lock(&mutex_);
    time = next_frame_;
  }
  StepAt(time);
}

void MapReplay::Stop() {
  stopped_ = true;
  std::shared_ptr<MapReader> reader;  // not let go under the lock
  std::function<void()> caught_up;
  std::unique_ptr<grpc::Alarm> alarm;
  absl::MutexLock lock(&mutex_);
  reader.swap(reader_);
  caught_up.swap(caught_up_);
  alarm.swap(alarm_);
}

std::shared_ptr<MapReader> MapReplay::reader() {
  absl::MutexLock lock(&mutex_);
  return reader_;
}

void MapReplay::StepAt(SteadyTime time) {
  if (time <= SteadyNow()) return Submit(&MapReplay::Step);
  const auto wait = std::chrono::duration_cast<std::chrono::microseconds>(time - SteadyNow());
  absl::MutexLock lock(&mutex_);
  if (reader_ == nullptr) return;
  // A new one, for the last may still be ringing.
  alarm_ = std::make_unique<grpc::Alarm>();
  alarm_->Set(std::chrono::system_clock::now() + wait, [weak = weak_from_this()](bool ok) {
    const auto self = weak.lock();
    if (ok && self != nullptr) self->Submit(&MapReplay::Step);
  });
}

void MapReplay::Submit(void (MapReplay::*task)()) {
  if (stopped_) return;
  if (!Queue(task).ok()) StepAt(After(SteadyNow(), kPoolRetry));
}

absl::Status MapReplay::Queue(void (MapReplay::*task)()) {
  const auto self = shared_from_this();
  return parts_.pool->Submit(parts_.turn, {[self, task] { (self.get()->*task)(); },
                                           [self] { return self->stopped_.load(); }});
}

void MapReplay::EndWith(const absl::Status& status) {
  if (const auto told = reader()) told->End(status);
}

void MapReplay::CatchUp() {
  past_ = {};  // its memory is free for others
  std::function<void()> caught_up;
  {
    absl::MutexLock lock(&mutex_);
    caught_up.swap(caught_up_);
  }
  if (caught_up) caught_up();
}

void MapReplay::Prepare() {
  if (stopped_) return;
  const absl::Status made = MakeFirst();
  if (!made.ok()) return EndWith(made);
  Show();
}

absl::Status MapReplay::MakeFirst() {
  PLUMESCOUT_ASSIGN_OR_RETURN(
      past_, parts_.missions->Make(*parts_.host, wish_.from_revision, "from_revision",
                                   PastUse::kReplay, [self = weak_from_this()] {
                                     const auto replay = self.lock();
                                     return replay == nullptr || replay->stopped_;
                                   }));
  began_ = SteadyNow();
  const std::int64_t time_ns = past_.mission->sample_time_ns();
  if (time_ns != 0) origin_ns_ = time_ns;
  return absl::OkStatus();
}

void MapReplay::Step() {
  if (stopped_) return;
  if (at_end_) return CatchUp();
  const auto progress = ApplyWhatIsDue();
  if (!progress.ok()) return EndWith(progress.status());
  at_end_ = *progress == Progress::kCaughtUp;
  if (past_.mission->revision() != held_) return Show();
  if (at_end_) return CatchUp();
  StepAt(After(SteadyNow(), std::clamp(wait_, std::max(parts_.period, kShortestWait),
                                       std::max(parts_.period, kLongestWait))));
}

absl::StatusOr<MapReplay::Progress> MapReplay::ApplyWhatIsDue() {
  const SteadyTime end = After(SteadyNow(), kMaxTimeAtOnce);
  for (int i = 0; i < kMaxEventsAtOnce && SteadyNow() < end; ++i) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const bool is_there, ReadNext());
    if (!is_there) return Progress::kCaughtUp;
    wait_ = WaitFor(next_->body);
    if (wait_ > absl::ZeroDuration()) break;
    const Event event = *std::exchange(next_, std::nullopt);
    const auto applied = past_.mission->Apply(event.body);
    if (absl::IsCancelled(applied.status())) return applied.status();
    if (!applied.ok()) return ReplayDiffers(event.number, applied.status());
  }
  return Progress::kMore;
}

absl::StatusOr<bool> MapReplay::ReadNext() {
  if (next_.has_value()) return true;
  // What came since the journal was opened takes another look.
  for (const bool is_new : {journal_ == nullptr, true}) {
    if (is_new) {
      PLUMESCOUT_ASSIGN_OR_RETURN(
          journal_,
          parts_.missions->store().Read(KeyOf(*parts_.host), past_.mission->revision() + 1));
    }
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<JournalRecord> record, journal_->Next());
    if (record.has_value()) {
      PLUMESCOUT_ASSIGN_OR_RETURN(next_, DecodeEvent(record->bytes));
      return true;
    }
    if (is_new) break;
  }
  journal_ = nullptr;
  return false;
}

absl::Duration MapReplay::WaitFor(const EventBody& body) {
  const auto* received = std::get_if<ObservationReceived>(&body);
  if (received == nullptr) return absl::ZeroDuration();
  const auto robot = past_.mission->StateOf(received->robot);
  const std::int64_t time_ns =
      MissionTime_ns(received->observation, robot.ok() ? robot->clock_offset_ns : 0);
  if (!origin_ns_.has_value()) {
    origin_ns_ = time_ns;
    began_ = SteadyNow();
  }
  const double since_s = 1e-9 * (static_cast<double>(time_ns) - static_cast<double>(*origin_ns_));
  const double shown_s = absl::ToDoubleSeconds(absl::FromChrono(SteadyNow() - began_));
  return absl::Seconds(std::max(0.0, since_s / wish_.speed_ratio - shown_s));
}

void MapReplay::Show() {
  const auto belief = past_.mission->Snapshot();
  auto frames = map_store_.FramesSince(held_, *belief, wish_.view);
  held_ = belief->revision;
  std::shared_ptr<MapReader> reader;
  {
    absl::MutexLock lock(&mutex_);
    reader = reader_;
    next_frame_ = After(SteadyNow(), parts_.period);
  }
  if (reader != nullptr) reader->Take(std::move(frames));
}

}  // namespace plumescout::server
