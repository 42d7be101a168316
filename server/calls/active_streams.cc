// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/active_streams.h"

#include <vector>

namespace plumescout::server {

void ActiveStreams::Add(const std::shared_ptr<EndableStream>& stream) {
  absl::Status ended;
  {
    absl::MutexLock lock(&mutex_);
    if (ended_.ok()) streams_.emplace(stream.get(), stream);
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
    for (const auto& [key, weak] : streams_) {
      if (auto stream = weak.lock()) open.push_back(std::move(stream));
    }
  }
  for (const auto& stream : open) stream->End(status);
}

int ActiveStreams::size() const {
  absl::MutexLock lock(&mutex_);
  return static_cast<int>(streams_.size());
}

}  // namespace plumescout::server
