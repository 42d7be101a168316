// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/status.h"

namespace plumescout {

// Planning works on a snapshot, so robots may come to want the same goal, or ways that meet; the
// first to commit gets them. Who loses that race searches again, on a newer belief; who loses too
// often is told so.
class CommitRace {
 public:
  // Whether to ask for a fresh belief and to search again, after a commit that ended so.
  bool SearchAgainAfter(const absl::Status& commit) {
    return absl::IsAborted(commit) && conflicts_++ < kMaxConflicts;
  }

 private:
  static constexpr int kMaxConflicts = 3;

  int conflicts_ = 0;
};

}  // namespace plumescout
