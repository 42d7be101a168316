// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "absl/time/time.h"

namespace plumescout::server {

// Typed errors that only a server makes; see core/types/error_reason.h.

// A queue or a pool is full: worth another try soon.
absl::Status Overloaded(absl::string_view what);
// A limit of the server's configuration is reached; waiting does not help.
absl::Status LimitReached(absl::string_view message);
// The caller asks for more than its share: worth another try after `wait`. `what` names the limit.
absl::Status RateExceeded(absl::string_view what, absl::Duration wait);
absl::Status Draining();
// kCancelled: nobody waits for the answer any more.
absl::Status GivenUp();
// STORE_UNAVAILABLE: nothing can be made durable now; worth another try when the disk is well
// again. `why` may have the reason already.
absl::Status StoreTakesNothing(absl::string_view why);
// The robot was told that more of its log is durable than the server has.
absl::Status StoreRolledBack(std::int64_t applied_sequence, std::int64_t told_sequence);
// What the store has of the mission cannot be used.
absl::Status MissionDamaged(absl::string_view mission, absl::string_view why);
// The mission is there, but not yet in memory.
absl::Status Recovering(absl::string_view mission);
// Calls for the mission do not reach the node that has it, which is to give it up.
absl::Status NodeUnreached(absl::string_view mission, absl::string_view node);
// The name alone does not tell which mission is meant.
absl::Status NameOfSeveral(absl::string_view mission);
// If it is RECOVERING, the same error of the mission of this key, for whoever is ready to wait for
// it; the wire does not tell the key.
absl::Status WithAwaitedMission(absl::Status status, absl::string_view key);
// That key; empty if there is none.
std::string AwaitedMission(const absl::Status& status);

// The same status as the wire tells it. It has an ErrorInfo: the reason of a typed error, or else
// the name of the code. Numbers that programs act on ("SEQUENCE_GAP: expected 7, ...") are metadata
// as well. A time after which to try again becomes a RetryInfo.
absl::Status WithErrorInfo(const absl::Status& status);

}  // namespace plumescout::server
