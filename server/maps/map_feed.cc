// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/maps/map_feed.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace plumescout::server {

absl::Status MapFeed::Join(const std::shared_ptr<MapReader>& reader, const MapView& view,
                           WorkerPool* pool, const Subscribe& subscribe) {
  {
    absl::MutexLock lock(&mutex_);
    places_[reader.get()] = {reader, view, pool};
  }
  // Each who joins has the present belief told; the first to be told listens on for all.
  const auto is_lasting = std::make_shared<bool>(false);
  const absl::Status status =
      subscribe([weak = weak_from_this(), is_lasting](absl::StatusOr<BeliefPtr> belief) {
        const auto feed = weak.lock();
        return feed != nullptr && feed->Update(std::move(belief), *is_lasting);
      });
  if (!status.ok()) Leave(reader.get());
  return status;
}

void MapFeed::Await(const MapReader* reader) {
  absl::MutexLock lock(&mutex_);
  const auto found = places_.find(reader);
  if (found == places_.end()) return;
  found->second.waits = true;
  if (IsBehind(found->second)) ServeSoon(found->second.pool);
}

int MapFeed::reader_count() const {
  absl::MutexLock lock(&mutex_);
  return static_cast<int>(places_.size());
}

void MapFeed::Leave(const MapReader* reader) {
  BeliefPtr last;  // not let go under the lock
  absl::MutexLock lock(&mutex_);
  places_.erase(reader);
  if (places_.empty()) newest_.swap(last);
}

bool MapFeed::Update(absl::StatusOr<BeliefPtr> belief, bool& is_lasting) {
  if (!belief.ok()) {
    EndAll(belief.status());
    return false;
  }
  absl::MutexLock lock(&mutex_);
  if (places_.empty()) {
    if (is_lasting) listens_ = false;
    return false;
  }
  if (!listens_) listens_ = is_lasting = true;
  newest_.swap(*belief);
  for (const auto& [reader, place] : places_) {
    if (!IsBehind(place)) continue;
    ServeSoon(place.pool);
    break;
  }
  return is_lasting;
}

void MapFeed::EndAll(const absl::Status& status) {
  std::map<const MapReader*, Place> places;
  {
    absl::MutexLock lock(&mutex_);
    listens_ = false;
    newest_ = nullptr;
    places.swap(places_);
  }
  for (const auto& [key, place] : places) {
    if (const auto reader = place.reader.lock()) reader->End(status);
  }
}

bool MapFeed::IsBehind(const Place& place) const {
  return place.waits && newest_ != nullptr && place.held < newest_->revision;
}

void MapFeed::ServeSoon(WorkerPool* pool) {
  if (is_queued_) return;
  is_queued_ = pool->Submit([self = shared_from_this()] { self->Serve(); }).ok();
}

void MapFeed::Serve() {
  std::vector<std::pair<std::shared_ptr<MapReader>, Place>> behind;
  BeliefPtr belief;
  {
    absl::MutexLock lock(&mutex_);
    is_queued_ = false;
    belief = newest_;
    for (auto& [key, place] : places_) {
      if (!IsBehind(place)) continue;
      auto reader = place.reader.lock();
      if (reader == nullptr) continue;
      place.waits = false;
      behind.emplace_back(std::move(reader), place);
    }
  }
  for (const auto& [reader, place] : behind) {
    auto frames = store_.FramesSince(place.held, *belief, place.view);
    {
      absl::MutexLock lock(&mutex_);
      const auto found = places_.find(reader.get());
      if (found == places_.end()) continue;
      found->second.held = frames->revision;
    }
    reader->Take(std::move(frames));
  }
}

}  // namespace plumescout::server
