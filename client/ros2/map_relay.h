// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <thread>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "client/backoff.h"
#include "client/viewer_client.h"

namespace plumescout::client {

struct MapRelayOptions {
  MissionId mission = {};
  absl::Duration period = absl::Seconds(1);  // no map is handed on sooner after the one before
  BackoffOptions backoff = {};               // after a watch has broken
};

// Watches the map of a mission on a thread of its own, and hands it on when it has changed. A watch
// that breaks is opened again.
class MapRelay {
 public:
  // On the relay's thread.
  struct Callbacks {
    std::function<void(const MapSnapshot&)> on_map;
    std::function<void(const absl::Status&)> on_broken;  // why; not for every try
  };

  // `client` must outlive it.
  MapRelay(ViewerClient& client, const MapRelayOptions& options, Callbacks callbacks);
  ~MapRelay();
  MapRelay(const MapRelay&) = delete;
  MapRelay& operator=(const MapRelay&) = delete;

 private:
  void Run();
  absl::Status Follow();
  // Whether it is to stop, which it is told within the time or not.
  bool StopsWithin(absl::Duration duration);

  ViewerClient& client_;
  const MapRelayOptions options_;
  const Callbacks callbacks_;
  absl::Mutex mutex_;
  bool stop_ ABSL_GUARDED_BY(mutex_) = false;
  MapWatch* watch_ ABSL_GUARDED_BY(mutex_) = nullptr;  // open; for its cancellation
  Backoff backoff_;
  std::thread thread_;
};

}  // namespace plumescout::client
