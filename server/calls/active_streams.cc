// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/active_streams.h"

#include <utility>
#include <vector>

namespace plumescout::server {

void ActiveStreams::Add(const std::shared_ptr<EndableStream>& stream) {
  absl::Status ended;
  {
    absl::MutexLock lock(&mutex_);
    if (ended_.ok()) streams_.emplace(stream.get(), Entry{stream});
    ended = ended_;
  }
  if (!ended.ok()) stream->End(ended);
}

void ActiveStreams::Remove(const EndableStream* stream) {
  absl::MutexLock lock(&mutex_);
  streams_.erase(stream);
}

void ActiveStreams::EndAll(const absl::Status& status) {
  std::vector<std::shared_ptr<EndableStream>> open;
  {
    absl::MutexLock lock(&mutex_);
    ended_ = status;
    for (const auto& [key, entry] : streams_) {
      if (auto stream = entry.stream.lock()) open.push_back(std::move(stream));
    }
  }
  for (const auto& stream : open) stream->End(status);
}

void ActiveStreams::LetIn(const EndableStream* stream, std::function<absl::Status()> recheck) {
  absl::MutexLock lock(&mutex_);
  const auto found = streams_.find(stream);
  if (found != streams_.end()) found->second.recheck = std::move(recheck);
}

int ActiveStreams::EndLockedOut() {
  std::vector<Entry> entries;
  {
    absl::MutexLock lock(&mutex_);
    for (const auto& [key, entry] : streams_) {
      if (entry.recheck) entries.push_back(entry);
    }
  }
  int ended = 0;
  for (const Entry& entry : entries) {
    const absl::Status status = entry.recheck();
    const auto stream = status.ok() ? nullptr : entry.stream.lock();
    if (stream == nullptr) continue;
    stream->End(status);
    ++ended;
  }
  return ended;
}

int ActiveStreams::size() const {
  absl::MutexLock lock(&mutex_);
  return static_cast<int>(streams_.size());
}

}  // namespace plumescout::server
