// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/time/time.h"

namespace plumescout::server {

// Connects to what this process listens on, says at once that nothing will follow, and waits until
// the other side says something or hangs up: any listener that accepts does one of them, whatever
// it speaks. That the connection is made says nothing, for the kernel does that by itself.
// kDeadlineExceeded if nothing comes of it in time; kUnavailable if there is no connection.
absl::Status Knock(const std::string& listen, int port, absl::Duration timeout);

}  // namespace plumescout::server
