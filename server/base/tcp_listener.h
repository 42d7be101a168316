// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/statusor.h"

namespace plumescout::server {

// A non-blocking socket that listens on HOST:PORT with a numeric host or localhost, which is
// 127.0.0.1; port 0: any free one. The caller closes it. kUnavailable naming the address.
absl::StatusOr<int> ListenOnTcp(const std::string& address);

// The port that the socket listens on; 0 if that cannot be told.
int ListenerPort(int listener);

}  // namespace plumescout::server
