// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/map_relay.h"

#include <utility>

#include "absl/time/clock.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

constexpr absl::Duration kRead = absl::Seconds(5);

}  // namespace

MapRelay::MapRelay(ViewerClient& client, const MapRelayOptions& options, Callbacks callbacks)
    : client_(client),
      options_(options),
      callbacks_(std::move(callbacks)),
      backoff_(options.backoff),
      thread_([this] { Run(); }) {}

MapRelay::~MapRelay() {
  {
    absl::MutexLock lock(&mutex_);
    stop_ = true;
    if (watch_ != nullptr) watch_->Cancel();
  }
  thread_.join();
}

bool MapRelay::StopsWithin(absl::Duration duration) {
  absl::MutexLock lock(&mutex_);
  return mutex_.AwaitWithTimeout(absl::Condition(&stop_), duration);
}

void MapRelay::Run() {
  absl::StatusCode told = absl::StatusCode::kOk;
  do {
    const absl::Status broken = Follow();
    // A mission that is not there yet, or a server that is away, is told once.
    if (broken.code() != told && !StopsWithin(absl::ZeroDuration())) callbacks_.on_broken(broken);
    told = broken.code();
  } while (!StopsWithin(backoff_.Next()));
}

absl::Status MapRelay::Follow() {
  MapWatchQuery query;
  query.view.full_precision = true;
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::unique_ptr<MapWatch> watch,
                              client_.WatchMap(options_.mission, query));
  {
    absl::MutexLock lock(&mutex_);
    if (stop_) return absl::CancelledError("told to stop");
    watch_ = watch.get();
  }
  absl::Status status;
  while (status.ok() || absl::IsDeadlineExceeded(status)) {
    status = watch->Read(kRead).status();
    if (!status.ok()) continue;
    backoff_.Reset();
    callbacks_.on_map(watch->map());
    if (StopsWithin(options_.period)) status = absl::CancelledError("told to stop");
  }
  absl::MutexLock lock(&mutex_);
  watch_ = nullptr;
  return status;
}

}  // namespace plumescout::client
