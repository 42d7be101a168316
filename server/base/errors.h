// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "absl/time/time.h"
#include "core/types/ids.h"

namespace plumescout::server {

// The server's typed errors. The message of each begins with its reason ("LEASE_HELD: ..."), which
// clients find again in google.rpc.ErrorInfo.

absl::Status MissionNotFound(const MissionId& mission);
absl::Status RobotNotFound(const RobotId& robot);
absl::Status LeaseHeld(const RobotId& robot, absl::Duration free_in);
absl::Status LeaseSuperseded(const RobotId& robot);
// A newer stream of the same client took the place of this one.
absl::Status StreamReplaced(const RobotId& robot);
absl::Status CreditExceeded(std::int64_t sequence, std::int64_t credit_sequence);
// A queue or a pool is full: worth another try soon.
absl::Status Overloaded(absl::string_view what);
// A limit of the server's configuration is reached; waiting does not help.
absl::Status LimitReached(absl::string_view message);
absl::Status Draining();

// The same status with an ErrorInfo, if it has none: the reason is the UPPER_SNAKE word before a
// colon at the start of the message, or else the name of the code. A hole in a robot's log
// ("SEQUENCE_GAP: expected 7, ...") gets the number as metadata.
absl::Status WithErrorInfo(const absl::Status& status);

}  // namespace plumescout::server
