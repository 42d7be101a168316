// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"

namespace plumescout::server {

// An open stream that can be ended from outside.
class EndableStream {
 public:
  virtual ~EndableStream() = default;
  // Must not block.
  virtual void End(const absl::Status& status) = 0;
};

// The open streams of a server. An open stream holds up a shutdown to its very deadline, so all
// are ended first. Thread-safe.
class ActiveStreams {
 public:
  // Streams that come after EndAll are ended at once.
  void Add(const std::shared_ptr<EndableStream>& stream);
  void Remove(const EndableStream* stream);
  void EndAll(const absl::Status& status);

  int size() const;

 private:
  mutable absl::Mutex mutex_;
  std::map<const EndableStream*, std::weak_ptr<EndableStream>> streams_ ABSL_GUARDED_BY(mutex_);
  absl::Status ended_ ABSL_GUARDED_BY(mutex_);  // OK while streams may open
};

}  // namespace plumescout::server
