// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/ingest_room.h"

#include <utility>
#include <variant>

namespace plumescout::server {

IngestLoad LoadOf(const std::vector<IncomingObservation>& batch) {
  IngestLoad load{static_cast<int>(batch.size()),
                  static_cast<std::int64_t>(batch.size() * sizeof(IncomingObservation))};
  for (const IncomingObservation& incoming : batch) {
    const auto* scan = std::get_if<Scan>(&incoming.observation.payload);
    if (scan == nullptr) continue;
    load.bytes += static_cast<std::int64_t>(scan->ranges_m.capacity() * sizeof(float));
  }
  return load;
}

bool IngestRoom::Fits(const IngestLoad& load) const {
  return used_.observations == 0 ||
         (load.observations <= limit_.observations - used_.observations &&
          load.bytes <= limit_.bytes - used_.bytes);
}

IngestRoom::Hold IngestRoom::Take(const IngestLoad& load) {
  used_.observations += load.observations;
  used_.bytes += load.bytes;
  return {this, [self = shared_from_this(), load](const void*) { self->GiveBack(load); }};
}

void IngestRoom::GiveBack(const IngestLoad& load) {
  {
    absl::MutexLock lock(&mutex_);
    used_.observations -= load.observations;
    used_.bytes -= load.bytes;
  }
  Grant();
}

IngestRoom::Hold IngestRoom::TryTake(const IngestLoad& load) {
  absl::MutexLock lock(&mutex_);
  if (!waiting_.empty() || !Fits(load)) return nullptr;
  return Take(load);
}

IngestRoom::Place IngestRoom::TakeOrWait(const IngestLoad& load, Granted granted) {
  Place place = 0;
  {
    absl::MutexLock lock(&mutex_);
    place = ++last_place_;
    waiting_.emplace(place, Waiting{load, std::move(granted)});
  }
  Grant();
  return place;
}

void IngestRoom::Withdraw(Place place) {
  std::map<Place, Waiting>::node_type withdrawn;  // what it holds goes outside the lock
  {
    absl::MutexLock lock(&mutex_);
    withdrawn = waiting_.extract(place);
  }
  Grant();  // whoever stood behind it may need less
}

void IngestRoom::Grant() {
  while (true) {
    Granted granted;
    Hold hold;
    {
      absl::MutexLock lock(&mutex_);
      if (waiting_.empty() || !Fits(waiting_.begin()->second.load)) return;
      auto first = waiting_.extract(waiting_.begin());
      hold = Take(first.mapped().load);
      granted = std::move(first.mapped().granted);
    }
    granted(std::move(hold));
  }
}

IngestLoad IngestRoom::used() const {
  absl::MutexLock lock(&mutex_);
  return used_;
}

int IngestRoom::waiting() const {
  absl::MutexLock lock(&mutex_);
  return static_cast<int>(waiting_.size());
}

}  // namespace plumescout::server
