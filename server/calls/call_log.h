// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/time/time.h"
#include "server/calls/door.h"

namespace plumescout::server {

// Logs calls that took longer than `slow_after`, with what they waited for, and those that failed
// by the server's fault; the others with level debug. Streams that last as long as their callers
// like are not slow.
class CallLog {
 public:
  explicit CallLog(absl::Duration slow_after) : slow_after_(slow_after) {}

  // A CallObserver.
  void Note(const CallInfo& info, const CallEnd& end) const;

 private:
  const absl::Duration slow_after_;
};

}  // namespace plumescout::server
