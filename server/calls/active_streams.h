// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
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

  // The stream's caller was let in; `recheck` says whether that still holds (null: for ever). No
  // effect if the stream is not there.
  void LetIn(const EndableStream* stream, std::function<absl::Status()> recheck);
  // Ends streams whose callers would not be let in any more, with what says so; returns how many.
  // Cost: a recheck for each stream.
  int EndLockedOut();

  int size() const;

 private:
  struct Entry {
    std::weak_ptr<EndableStream> stream;
    std::function<absl::Status()> recheck = nullptr;
  };

  mutable absl::Mutex mutex_;
  std::map<const EndableStream*, Entry> streams_ ABSL_GUARDED_BY(mutex_);
  absl::Status ended_ ABSL_GUARDED_BY(mutex_);  // OK while streams may open
};

}  // namespace plumescout::server
