// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace plumescout::server {

// Between a job that commits something and a caller that gives up: either nothing is committed, or
// the job goes on as if nobody had given up, so that what was committed is told of. Thread-safe.
class CommitGuard {
 public:
  // False if the caller has given up, and has been told so: nothing may be committed.
  bool Begin() {
    is_committing_ = true;
    if (!given_up_) return true;
    is_committing_ = false;
    return false;
  }
  // Nothing was committed after Begin. False if the caller has given up meanwhile, and is to be
  // told so.
  bool Undo() {
    is_committing_ = false;
    return !given_up_;
  }
  // The caller gives up. True if it is to be told so.
  bool GiveUp() {
    given_up_ = true;
    return !is_committing_;
  }

 private:
  // Each side sets its own before it looks at that of the other: one of them sees both.
  std::atomic<bool> is_committing_ = false;
  std::atomic<bool> given_up_ = false;
};

}  // namespace plumescout::server
