// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/status.h"

namespace plumescout {

// Planning works on a snapshot, so robots may come to want the same goal; the first to commit gets
// it. Who loses that race searches once more, on a newer belief; who loses again is told so.
class CommitRace {
 public:
  // Whether to ask for a fresh belief and to search again, after a commit that ended so.
  bool SearchAgainAfter(const absl::Status& commit) {
    return absl::IsAborted(commit) && conflicts_++ < kMaxConflicts;
  }

 private:
  static constexpr int kMaxConflicts = 1;

  int conflicts_ = 0;
};

}  // namespace plumescout
