// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/strings/string_view.h"

namespace plumescout::server {

// Whether it begins with "unix:" or "unix-abstract:".
bool IsUnixAddress(absl::string_view address);

// Whether nobody from another machine comes in by this address to listen on: a loopback address, a
// Unix socket, or none. Names other than localhost are not looked up.
bool IsLocalAddress(absl::string_view listen);

// The same of a caller's address as gRPC writes it: "ipv4:127.0.0.1:4711", "ipv6:%5B::1%5D:4711",
// "unix:", "inproc"; "unknown" is what it calls one that has no address, a call within the process.
bool IsLocalPeer(absl::string_view peer);

// Host and port of "10.0.0.1:50551" or "[::1]:50551"; the port is empty if there is none.
struct HostPort {
  std::string host;
  std::string port;
};
HostPort SplitHostPort(absl::string_view address);

}  // namespace plumescout::server
