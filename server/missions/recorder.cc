// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/recorder.h"

#include <utility>
#include <variant>

#include "absl/time/time.h"
#include "server/base/thread_priority.h"

namespace plumescout::server {
namespace {

// Chunks are looked at this often.
constexpr absl::Duration kLook = absl::Seconds(1);

// What it takes to keep the moment for a while. Beliefs share rasters with the mission until these
// change, which soon they do.
std::int64_t BytesOf(const MissionMoment& moment) {
  auto bytes = static_cast<std::int64_t>(sizeof(moment));
  if (const auto* received = std::get_if<ObservationReceived>(&moment.event.body)) {
    if (const auto* scan = std::get_if<Scan>(&received->observation.payload)) {
      bytes += std::ssize(scan->ranges_m) * std::int64_t{sizeof(scan->ranges_m[0])};
    }
  } else if (const auto* issued = std::get_if<PlanIssued>(&moment.event.body)) {
    constexpr std::int64_t kBytesOfCandidate = 1024;
    bytes += kBytesOfCandidate * (1 + std::ssize(issued->plan.candidates));
  }
  if (moment.belief != nullptr) {
    constexpr std::int64_t kBytesOfCell = 16;
    bytes += kBytesOfCell * static_cast<std::int64_t>(moment.belief->geometry().size());
  }
  return bytes;
}

}  // namespace

Recorder::Recorder(RecordingOptions options, MissionMetrics* metrics, std::int64_t max_queued_bytes)
    : options_(std::move(options)),
      metrics_(*metrics),
      max_queued_bytes_(max_queued_bytes),
      thread_([this] { Run(); }) {}

Recorder::~Recorder() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  thread_.join();
}

std::unique_ptr<RecordingFeed> Recorder::Begin(const JournalStart& start, const std::string& key) {
  return std::make_unique<RecordingFeed>(
      this, std::make_shared<MissionRecording>(start, key, options_, &metrics_),
      options_.map_period_s);
}

bool Recorder::Push(Item item) {
  absl::MutexLock lock(&mutex_);
  if (item.moment && queued_bytes_ + item.bytes > max_queued_bytes_) {
    metrics_.NoteRecordingDrop();
    return false;
  }
  queued_bytes_ += item.bytes;
  items_.push_back(std::move(item));
  return true;
}

std::optional<Recorder::Item> Recorder::Take(bool& stops) {
  absl::MutexLock lock(&mutex_);
  mutex_.AwaitWithTimeout(absl::Condition(this, &Recorder::HasWork), kLook);
  stops = stopping_ && items_.empty();
  if (items_.empty()) return std::nullopt;
  Item item = std::move(items_.front());
  items_.pop_front();
  return item;
}

void Recorder::Run() {
  YieldCpuToOthers();
  SteadyTime next_look = After(SteadyNow(), kLook);
  for (bool stops = false; !stops;) {
    std::optional<Item> item = Take(stops);
    if (item) Write(*std::move(item));
    const SteadyTime now = SteadyNow();
    if (now < next_look) continue;
    for (const auto& recording : recordings_) recording->EndChunkIfDue(now);
    next_look = After(now, kLook);
  }
  for (const auto& recording : recordings_) recording->Finish(nullptr, SteadyNow());
}

void Recorder::Write(Item item) {
  if (item.moment) {
    recordings_.insert(item.recording);
    item.recording->Add(*std::move(item.moment), item.missing, SteadyNow());
  } else {
    item.recording->Finish(item.last_belief, SteadyNow());
    recordings_.erase(item.recording);
  }
  absl::MutexLock lock(&mutex_);
  queued_bytes_ -= item.bytes;
}

RecordingFeed::RecordingFeed(Recorder* recorder, std::shared_ptr<MissionRecording> recording,
                             double map_period_s)
    : recorder_(*recorder), recording_(std::move(recording)), map_timer_(map_period_s) {}

void RecordingFeed::Note(const Event& event, const Applied& applied, const Mission& mission) {
  Recorder::Item item{.recording = recording_,
                      .moment = MomentAfter(event, applied, mission, map_timer_),
                      .missing = missing_};
  item.bytes = BytesOf(*item.moment);
  missing_ = recorder_.Push(std::move(item)) ? 0 : missing_ + 1;
}

void RecordingFeed::End(const Mission& mission) {
  recorder_.Push({.recording = recording_, .moment = {}, .last_belief = mission.Snapshot()});
}

}  // namespace plumescout::server
