// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/address.h"

#include <arpa/inet.h>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/strip.h"

namespace plumescout::server {
namespace {

bool IsLoopback(const std::string& host) {
  in6_addr v6;
  if (inet_pton(AF_INET6, host.c_str(), &v6) == 1) return IN6_IS_ADDR_LOOPBACK(&v6);
  constexpr unsigned int kLoopbackNet = 127;
  in_addr v4;
  return inet_pton(AF_INET, host.c_str(), &v4) == 1 && ntohl(v4.s_addr) >> 24 == kLoopbackNet;
}

}  // namespace

bool IsUnixAddress(absl::string_view address) {
  return absl::StartsWith(address, "unix:") || absl::StartsWith(address, "unix-abstract:");
}

bool IsLocalAddress(absl::string_view listen) {
  if (listen.empty() || IsUnixAddress(listen)) return true;
  const std::string host = SplitHostPort(listen).host;
  return host == "localhost" || IsLoopback(host);
}

bool IsLocalPeer(absl::string_view peer) {
  // Calls within the process have no address, which gRPC calls "unknown"; sockets always have one.
  if (peer == "inproc" || peer == "unknown" || IsUnixAddress(peer)) return true;
  const std::string address = absl::StrReplaceAll(peer, {{"%5B", "["}, {"%5D", "]"}});
  absl::string_view host_port = address;
  if (!absl::ConsumePrefix(&host_port, "ipv4:") && !absl::ConsumePrefix(&host_port, "ipv6:")) {
    return false;
  }
  return IsLoopback(SplitHostPort(host_port).host);
}

HostPort SplitHostPort(absl::string_view address) {
  if (absl::ConsumePrefix(&address, "[")) {
    const std::size_t end = address.find(']');
    const absl::string_view host = address.substr(0, end);
    absl::string_view port = end == absl::string_view::npos ? "" : address.substr(end + 1);
    absl::ConsumePrefix(&port, ":");
    return {std::string(host), std::string(port)};
  }
  const std::size_t colon = address.rfind(':');
  if (colon == absl::string_view::npos) return {std::string(address), ""};
  return {std::string(address.substr(0, colon)), std::string(address.substr(colon + 1))};
}

}  // namespace plumescout::server
