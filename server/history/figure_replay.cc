// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/figure_replay.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "core/types/status_macros.h"
#include "formats/journal/event_codec.h"
#include "server/history/mission_figures.h"

namespace plumescout::server {
namespace {

// Figures of a mission: about so many at first, and never more than twice that.
constexpr std::int64_t kFigures = 200;
// For fewer new events the journal is not replayed again.
constexpr std::int64_t kMinNewEvents = 100;
// Nor within so much time, or within as much as it took the last time: where events come faster
// than they are replayed, who asks until there is no more would ask for ever.
constexpr absl::Duration kShortestRest = absl::Seconds(5);
// A task ends after so much: others wait for the pool's thread.
constexpr absl::Duration kLongestStep = absl::Milliseconds(100);

}  // namespace

FigureReplay::FigureReplay(const std::shared_ptr<MissionHost>& host, PastMissions* missions,
                           SteadyClock clock)
    : host_(host), missions_(*missions), clock_(std::move(clock)), asked_(clock_()) {}

absl::StatusOr<v1::GetMissionFiguresResponse> FigureReplay::Ask(const PoolTurn& turn) {
  asked_ = clock_();
  const auto host = host_.lock();
  const std::int64_t head = host == nullptr ? 0 : host->summary().revision;
  absl::MutexLock lock(&mutex_);
  if (!failure_.ok()) return std::exchange(failure_, absl::OkStatus());
  if (!running_ && IsBehind(head)) {
    PLUMESCOUT_RETURN_IF_ERROR(Queue(turn));
    running_ = true;
    began_ = clock_();
  }
  v1::GetMissionFiguresResponse response;
  response.mutable_figures()->Assign(figures_.begin(), figures_.end());
  response.set_more_follow(running_);
  return response;
}

bool FigureReplay::IsBehind(std::int64_t head) const {
  if (reached_ == 0) return head > 0;
  return head - reached_ >= std::max(stride_, kMinNewEvents) && clock_() >= rests_until_;
}

bool FigureReplay::IsAbandoned() const {
  return ended_ || clock_() >= After(asked_.load(), kPatience);
}

absl::Status FigureReplay::Queue(const PoolTurn& turn) {
  return turn.pool->Submit(turn.key, {[self = shared_from_this(), turn] { self->Step(turn); }});
}

void FigureReplay::Step(const PoolTurn& turn) {
  const auto host = host_.lock();
  if (host == nullptr || IsAbandoned()) return Rest(absl::OkStatus());
  const auto progress = Advance(*host);
  if (!progress.ok()) return Rest(progress.status());
  if (*progress == Progress::kDone) {
    NoteEnd();
    return Rest(absl::OkStatus());
  }
  const absl::Status queued = Queue(turn);
  if (!queued.ok()) Rest(queued);
}

absl::StatusOr<FigureReplay::Progress> FigureReplay::Advance(MissionHost& host) {
  if (past_.mission == nullptr) PLUMESCOUT_RETURN_IF_ERROR(Begin(host));
  const SteadyTime end = After(SteadyNow(), kLongestStep);
  while (SteadyNow() < end) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<JournalRecord> record, journal_->Next());
    if (record.has_value()) PLUMESCOUT_RETURN_IF_ERROR(ApplyNext(*record));
    if (!record.has_value() || past_.mission->revision() >= due_) NoteFigures(host.id());
    if (!record.has_value()) return Progress::kDone;
  }
  return Progress::kMore;
}

absl::Status FigureReplay::Begin(MissionHost& host) {
  const std::string key = KeyOf(host);
  PLUMESCOUT_ASSIGN_OR_RETURN(const AcquiredMission stored, missions_.store().Peek(key));
  std::int64_t from = 0;
  {
    absl::MutexLock lock(&mutex_);
    from = std::max(reached_, stored.first - 1);
    if (stride_ == 0) stride_ = std::max<std::int64_t>(1, stored.head / kFigures);
    due_ = figures_.empty() ? from : figures_.back().revision() + stride_;
  }
  // A server that goes down does not wait for it.
  end_listener_ = host.end_listeners().Add([weak = weak_from_this()](const absl::Status&) {
    if (const auto self = weak.lock()) self->ended_ = true;
  });
  PLUMESCOUT_ASSIGN_OR_RETURN(
      past_, missions_.Make(host, from, "revision", PastUse::kFigures, [weak = weak_from_this()] {
        const auto self = weak.lock();
        return self == nullptr || self->IsAbandoned();
      }));
  if (begin_ns_ == 0) begin_ns_ = past_.mission->sample_time_ns();
  PLUMESCOUT_ASSIGN_OR_RETURN(journal_, missions_.store().Read(key, from + 1));
  return absl::OkStatus();
}

absl::Status FigureReplay::ApplyNext(const JournalRecord& record) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const Event event, DecodeEvent(record.bytes));
  const auto applied = past_.mission->Apply(event.body);
  if (absl::IsCancelled(applied.status())) return applied.status();
  if (!applied.ok()) return ReplayDiffers(event.number, applied.status());
  if (begin_ns_ == 0) begin_ns_ = past_.mission->sample_time_ns();
  return absl::OkStatus();
}

void FigureReplay::NoteFigures(const MissionId& mission) {
  const auto belief = past_.mission->Snapshot();
  const bool is_there = begin_ns_ != 0 && belief->geometry().size() > 0;
  v1::MissionFigures figures;
  if (is_there) figures = FiguresOf(*belief, mission, begin_ns_);
  absl::MutexLock lock(&mutex_);
  const bool is_new = figures_.empty() || figures_.back().revision() < belief->revision;
  if (is_there && is_new) figures_.push_back(std::move(figures));
  if (std::ssize(figures_) > 2 * kFigures) {
    for (std::size_t i = 1; 2 * i < figures_.size(); ++i) figures_[i] = figures_[2 * i];
    figures_.resize((figures_.size() + 1) / 2);
    stride_ *= 2;
  }
  due_ = belief->revision + stride_;
}

void FigureReplay::NoteEnd() {
  absl::MutexLock lock(&mutex_);
  const SteadyTime now = clock_();
  rests_until_ = std::max(After(now, kShortestRest), now + (now - began_));
}

void FigureReplay::Rest(const absl::Status& status) {
  const std::int64_t reached = past_.mission == nullptr ? 0 : past_.mission->revision();
  past_ = {};  // its memory is free for others
  journal_ = nullptr;
  if (const auto host = host_.lock()) host->end_listeners().Remove(end_listener_);
  absl::MutexLock lock(&mutex_);
  reached_ = std::max(reached_, reached);
  running_ = false;
  if (!absl::IsCancelled(status)) failure_ = status;
}

}  // namespace plumescout::server
