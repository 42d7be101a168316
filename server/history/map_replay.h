// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/alarm.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "core/types/event.h"
#include "proto/convert/map.h"
#include "server/base/clock.h"
#include "server/base/fair_pool.h"
#include "server/history/past_missions.h"
#include "server/maps/map_feed.h"
#include "server/maps/map_store.h"
#include "server/missions/mission_host.h"

namespace plumescout::server {

// What is shown again, and how fast.
struct ReplayWish {
  MapView view = {};
  std::int64_t from_revision = 0;
  double speed_ratio = 1.0;  // times as fast as it happened, by the robots' clocks
};

// Shows one reader how a mission's map became what it is: from the journal, on a mission of its
// own, until all that is durable was shown. It works only while the reader waits, in short tasks on
// a pool; so a reader that is slow skips revisions, and one that has left costs nothing.
// Thread-safe; nothing blocks.
class MapReplay : public std::enable_shared_from_this<MapReplay> {
 public:
  struct Parts {
    std::shared_ptr<MissionHost> host;
    PastMissions* missions = nullptr;  // not owned, as is the pool; both outlive the replay
    FairPool* pool = nullptr;
    FairKey turn = {};                                // whose it is there
    absl::Duration period = absl::Milliseconds(100);  // between frames, at least
  };

  MapReplay(Parts parts, const ReplayWish& wish);

  // The reader gets the map of the first revision, and others each time he waits. Then `caught_up`
  // is called, once: there is no more. OVERLOADED: nothing begins.
  absl::Status Begin(std::shared_ptr<MapReader> reader, std::function<void()> caught_up);
  // The reader is done with the frames that he took.
  void Await() ABSL_LOCKS_EXCLUDED(mutex_);
  // Nobody reads any more. What runs ends soon.
  void Stop() ABSL_LOCKS_EXCLUDED(mutex_);

 private:
  enum class Progress { kMore, kCaughtUp };

  // On the pool, one after the other.
  void Prepare();
  void Step();
  absl::Status MakeFirst();
  absl::StatusOr<Progress> ApplyWhatIsDue();
  // Reads on; false if there is nothing more that is durable.
  absl::StatusOr<bool> ReadNext();
  // How long it is until the event was, zero: it was.
  absl::Duration WaitFor(const EventBody& body);
  void Show();

  void StepAt(SteadyTime time);
  // Again and again until there is room.
  void Submit(void (MapReplay::*task)());
  absl::Status Queue(void (MapReplay::*task)());
  void EndWith(const absl::Status& status);
  void CatchUp();
  std::shared_ptr<MapReader> reader() ABSL_LOCKS_EXCLUDED(mutex_);

  const Parts parts_;
  const ReplayWish wish_;
  std::atomic<bool> stopped_ = false;

  // Touched by the tasks only.
  PastMission past_;
  MapStore map_store_;
  std::unique_ptr<JournalReader> journal_;  // null: read anew
  std::optional<Event> next_;               // read, not due yet
  std::int64_t held_ = kHoldsNothing;       // the revision that the reader has
  std::optional<std::int64_t> origin_ns_;   // the sample time that is shown at ...
  SteadyTime began_;                        // ... this time
  bool at_end_ = false;                     // what was shown last is all there is
  absl::Duration wait_;                     // for the next event, where nothing was due

  absl::Mutex mutex_;
  std::shared_ptr<MapReader> reader_ ABSL_GUARDED_BY(mutex_);  // until Stop
  std::function<void()> caught_up_ ABSL_GUARDED_BY(mutex_);
  SteadyTime next_frame_ ABSL_GUARDED_BY(mutex_);
  std::unique_ptr<grpc::Alarm> alarm_ ABSL_GUARDED_BY(mutex_);  // of the last wait
};

}  // namespace plumescout::server
