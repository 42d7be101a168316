// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

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

// The same status as the wire tells it. It has an ErrorInfo: the reason of a typed error, or else
// the name of the code. A hole in a robot's log ("SEQUENCE_GAP: expected 7, ...") gets the number
// as metadata. A time after which to try again becomes a RetryInfo.
absl::Status WithErrorInfo(const absl::Status& status);

}  // namespace plumescout::server
