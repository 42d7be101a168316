// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/types/objective.h"
#include "core/types/options.h"

namespace plumescout {

// What assessments say of an objective, once they have said it for ObjectiveOptions::hold_s.
// Verdicts that rest on there being nothing left to know have to hold, for what lies behind a door
// that is shut for a moment is not seen; a cell above the threshold stays above it.
// Thread-compatible.
class HeldVerdict {
 public:
  // What an assessment counts as that says `state`: kPursued for now, if that has to hold longer.
  // Where robots have nothing left to do, nothing waits. Times are those of samples.
  ObjectiveState Take(ObjectiveState state, const ObjectiveOptions& objective, std::int64_t now_ns,
                      bool nothing_left_to_do);
  // The verdict that has held or is to hold; kPursued: there is none.
  ObjectiveState pending() const { return state_; }
  // Whether there is none that could still be taken back.
  bool IsSettled(const ObjectiveOptions& objective, std::int64_t now_ns) const;

  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self) {
    archive(self.state_, self.since_ns_);
  }
  bool empty() const { return state_ == ObjectiveState::kPursued && since_ns_ == 0; }

 private:
  ObjectiveState state_ = ObjectiveState::kPursued;
  std::int64_t since_ns_ = 0;
};

}  // namespace plumescout
