// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_recorder.h"

#include <chrono>
#include <iterator>
#include <variant>

#include "absl/time/time.h"
#include "formats/draw/robot_drawing.h"

namespace plumescout::client {
namespace {

// Chunks are looked at this often.
constexpr absl::Duration kLook = absl::Seconds(1);
constexpr std::int64_t kPlacePeriod_ns = 200'000'000;

// What it takes to keep it for a while.
std::int64_t BytesOf(const RobotNews& news) {
  auto bytes = static_cast<std::int64_t>(sizeof(news));
  if (const auto* observation = std::get_if<Observation>(&news)) {
    if (const auto* scan = std::get_if<Scan>(&observation->payload)) {
      bytes += std::ssize(scan->ranges_m) * std::int64_t{sizeof(scan->ranges_m[0])};
    }
  } else if (const auto* given = std::get_if<PlanGiven>(&news)) {
    constexpr std::int64_t kBytesOfCandidate = 1024;
    bytes += kBytesOfCandidate * (1 + std::ssize(given->plan.candidates));
  } else if (const auto* line = std::get_if<SaidLine>(&news)) {
    bytes += std::ssize(line->text);
  }
  return bytes;
}

}  // namespace

RobotRecorder::RobotRecorder(const RobotRecordingOptions& options,
                             const Participation& participation, std::int64_t time_ns,
                             RobotObserver* next, std::int64_t max_queued_bytes)
    : next_(*next),
      max_queued_bytes_(max_queued_bytes),
      recording_(options, participation, time_ns),
      thread_([this] { Run(); }) {}

RobotRecorder::~RobotRecorder() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  thread_.join();
}

void RobotRecorder::OnTick(const RobotTick& tick) {
  if (IsDue(tick.time_ns, kPlacePeriod_ns, place_ns_)) Push(RobotPlace{tick.time_ns, tick.pose});
  next_.OnTick(tick);
}

void RobotRecorder::OnLogged(const Observation& observation) {
  Push(observation);
  next_.OnLogged(observation);
}

void RobotRecorder::OnPlan(const PlanArrival& arrival) {
  Push(PlanGiven{arrival.time_ns, arrival.plan});
  next_.OnPlan(arrival);
}

void RobotRecorder::OnReport(PlanId plan, ProgressOutcome outcome) {
  Push(PlanEnded{});
  next_.OnReport(plan, outcome);
}

void RobotRecorder::Push(RobotNews news) {
  const std::int64_t bytes = BytesOf(news);
  absl::MutexLock lock(&mutex_);
  if (queued_bytes_ + bytes > max_queued_bytes_) {
    ++missing_;
    return;
  }
  queued_bytes_ += bytes;
  items_.push_back({std::move(news), std::exchange(missing_, 0), bytes});
}

std::optional<RobotRecorder::Item> RobotRecorder::Take(bool& stops) {
  absl::MutexLock lock(&mutex_);
  mutex_.AwaitWithTimeout(absl::Condition(this, &RobotRecorder::HasWork), kLook);
  stops = stopping_ && items_.empty();
  if (items_.empty()) return std::nullopt;
  Item item = std::move(items_.front());
  items_.pop_front();
  queued_bytes_ -= item.bytes;
  return item;
}

void RobotRecorder::Run() {
  const auto now = [] { return std::chrono::steady_clock::now(); };
  for (bool stops = false; !stops;) {
    const std::optional<Item> item = Take(stops);
    if (item) recording_.Add(item->news, item->missing, now());
    recording_.EndChunkIfDue(now());
  }
  std::int64_t missing = 0;
  {
    absl::MutexLock lock(&mutex_);
    missing = missing_;
  }
  recording_.Finish(missing, now());
}

}  // namespace plumescout::client
