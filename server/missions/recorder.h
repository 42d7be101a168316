// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "core/mission/mission.h"
#include "core/types/event.h"
#include "formats/view/mission_view.h"
#include "server/missions/mission_recording.h"

namespace plumescout::server {

class RecordingFeed;

// Records missions while they run, on a thread of its own: no mission waits for the disk. What it
// is handed waits in a queue, which is bounded; events beyond it are dropped, counted, and told of
// in the file. Outlives its feeds. Thread-safe.
class Recorder {
 public:
  // What waits, of all missions, by estimate.
  static constexpr std::int64_t kMaxQueuedBytes = std::int64_t{64} << 20;

  // `metrics` is not owned and outlives this.
  Recorder(RecordingOptions options, MissionMetrics* metrics,
           std::int64_t max_queued_bytes = kMaxQueuedBytes);
  // Writes what waits, and ends all files.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // Of a mission that begins, or goes on, with its next event. `key` is MissionKey.
  std::unique_ptr<RecordingFeed> Begin(const JournalStart& start, const std::string& key);

 private:
  friend class RecordingFeed;

  struct Item {
    std::shared_ptr<MissionRecording> recording;
    std::optional<MissionMoment> moment;                  // none: the mission ends, ...
    std::shared_ptr<const Belief> last_belief = nullptr;  // ... like this
    std::int64_t missing = 0;                             // events of the mission before it
    std::int64_t bytes = 0;
  };

  // False, and counted, if it is dropped: there is no room. Ends always have room.
  bool Push(Item item);
  void Run();
  // Waits for one a while. Nothing: there was none; `stops` if none will come.
  std::optional<Item> Take(bool& stops);
  void Write(Item item);
  bool HasWork() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return !items_.empty() || stopping_;
  }

  const RecordingOptions options_;
  MissionMetrics& metrics_;
  const std::int64_t max_queued_bytes_;
  std::set<std::shared_ptr<MissionRecording>> recordings_;  // of the thread

  absl::Mutex mutex_;
  std::deque<Item> items_ ABSL_GUARDED_BY(mutex_);
  std::int64_t queued_bytes_ ABSL_GUARDED_BY(mutex_) = 0;
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;

  std::thread thread_;  // last: it uses all of the above
};

// What the writer of one mission tells the recorder of. Single-threaded; never blocks on the disk.
class RecordingFeed {
 public:
  RecordingFeed(Recorder* recorder, std::shared_ptr<MissionRecording> recording,
                double map_period_s);

  // The mission has just applied it.
  void Note(const Event& event, const Applied& applied, const Mission& mission);
  // Nothing follows.
  void End(const Mission& mission);

 private:
  Recorder& recorder_;
  const std::shared_ptr<MissionRecording> recording_;
  MapTimer map_timer_;
  std::int64_t missing_ = 0;  // events that were dropped since the last that was not
};

}  // namespace plumescout::server
