// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <string>

#include "absl/base/thread_annotations.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "core/belief/belief.h"
#include "core/types/stop.h"
#include "proto/convert/map.h"
#include "server/history/past_missions.h"
#include "server/maps/encoded_map.h"
#include "server/missions/mission_host.h"

namespace plumescout::server {

// Which part of which past map.
struct PastMapWish {
  std::int64_t revision = 0;
  MapView view = {};
  std::string part_token = {};  // empty: the first part
  std::int64_t max_bytes = 0;   // 0, or what the caller wants less than the server allows
};

// Maps of missions as they were, and what else can be seen of them. The encoded maps that were made
// last are kept for whoever reads them in parts, and the last belief for whoever asks of it next;
// what is not kept any more is made again, the same. Thread-safe.
class PastMaps {
 public:
  explicit PastMaps(PastMissions* missions) : missions_(*missions) {}

  // A v1::GetMapResponse. Errors as PastMissions::Make, and kInvalidArgument for a token of another
  // map. Not for reactors.
  absl::StatusOr<grpc::ByteBuffer> Part(const std::shared_ptr<MissionHost>& host,
                                        const PastMapWish& wish, const StopFn& stop);

  // Without what only plans need of the gas. Errors as PastMissions::Make. Not for reactors.
  absl::StatusOr<std::shared_ptr<const Belief>> BeliefAt(const std::shared_ptr<MissionHost>& host,
                                                         std::int64_t revision, const StopFn& stop)
      ABSL_LOCKS_EXCLUDED(mutex_);

 private:
  using EncodedPtr = std::shared_ptr<const EncodedMap>;
  struct Kept {
    std::weak_ptr<MissionHost> host;  // another mission may get its name
    EncodedPtr map;
  };

  absl::StatusOr<EncodedPtr> Encode(const std::shared_ptr<MissionHost>& host,
                                    const PastMapWish& wish, const StopFn& stop);
  EncodedPtr Find(const std::shared_ptr<MissionHost>& host, const PastMapWish& wish)
      ABSL_LOCKS_EXCLUDED(mutex_);
  void Keep(Kept kept) ABSL_LOCKS_EXCLUDED(mutex_);

  PastMissions& missions_;

  absl::Mutex mutex_;
  std::deque<Kept> kept_ ABSL_GUARDED_BY(mutex_);  // the newest last
  std::weak_ptr<MissionHost> belief_host_ ABSL_GUARDED_BY(mutex_);
  std::shared_ptr<const Belief> belief_ ABSL_GUARDED_BY(mutex_);  // the last; null: none yet
};

}  // namespace plumescout::server
