// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/attacks/raw_connection.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"

namespace plumescout::lab {
namespace {

constexpr int kPatience_ms = 1000;

}  // namespace

absl::StatusOr<std::unique_ptr<RawConnection>> RawConnection::Open(const std::string& target) {
  const std::size_t colon = target.rfind(':');
  int port = 0;
  if (colon == std::string::npos || !absl::SimpleAtoi(target.substr(colon + 1), &port)) {
    return absl::InvalidArgumentError(absl::StrCat(target, " is not host:port"));
  }
  const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return absl::ErrnoToStatus(errno, "socket");
  auto connection = std::make_unique<RawConnection>(Private(), fd);
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_addr.s_addr = htonl(INADDR_LOOPBACK + 1);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&own), sizeof(own)) != 0) {
    return absl::ErrnoToStatus(errno, "binding to 127.0.0.2");
  }
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    return absl::ErrnoToStatus(errno, absl::StrCat("connecting to ", target));
  }
  return connection;
}

RawConnection::~RawConnection() { close(fd_); }

std::string RawConnection::Receive() {
  std::string received;
  std::array<char, 1 << 16> bytes{};
  ssize_t size = 0;
  while ((size = recv(fd_, bytes.data(), bytes.size(), MSG_DONTWAIT)) > 0) {
    received.append(bytes.data(), static_cast<std::size_t>(size));
  }
  return received;
}

absl::Status RawConnection::Send(absl::string_view bytes) {
  while (!bytes.empty()) {
    Receive();
    const ssize_t sent = send(fd_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      pollfd ready{fd_, POLLOUT | POLLIN, 0};
      if (poll(&ready, 1, kPatience_ms) <= 0) return absl::UnavailableError("nobody reads");
    } else {
      return absl::ErrnoToStatus(errno, "sending");
    }
  }
  return absl::OkStatus();
}

}  // namespace plumescout::lab
