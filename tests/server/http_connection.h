// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace plumescout::server {

// A connection that reads when it is told to.
class HttpConnection {
 public:
  explicit HttpConnection(int port) : fd_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  }
  ~HttpConnection() { close(fd_); }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  void Send(const std::string& text) const { EXPECT_TRUE(TrySend(text)); }
  // False if the other side does not take all of it.
  bool TrySend(const std::string& text) const {
    return send(fd_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
  }
  // An option of the socket at the other side, which is in this process; -1: there is none.
  int OptionOfPeer(int level, int name) const {
    sockaddr_in here{};
    socklen_t size = sizeof(here);
    getsockname(fd_, reinterpret_cast<sockaddr*>(&here), &size);
    for (int fd = 0; fd < kMaxDescriptor; ++fd) {
      sockaddr_in peer{};
      size = sizeof(peer);
      if (getpeername(fd, reinterpret_cast<sockaddr*>(&peer), &size) != 0) continue;
      if (peer.sin_family != AF_INET || peer.sin_port != here.sin_port) continue;
      int value = -1;
      size = sizeof(value);
      return getsockopt(fd, level, name, &value, &size) == 0 ? value : -1;
    }
    return -1;
  }
  void EndSending() const { shutdown(fd_, SHUT_WR); }
  // Bytes until the other side closes.
  std::size_t CountToEnd() const {
    std::size_t received = 0;
    std::array<char, 65'536> part{};
    for (ssize_t count = 1; count > 0;
         received += static_cast<std::size_t>(std::max<ssize_t>(count, 0))) {
      count = recv(fd_, part.data(), part.size(), 0);
    }
    return received;
  }
  // Until this comes, or the other side closes.
  std::string ReadTo(const std::string& end) const {
    std::string received;
    std::array<char, 4096> part{};
    while (received.find(end) == std::string::npos) {
      const ssize_t count = recv(fd_, part.data(), part.size(), 0);
      if (count <= 0) break;
      received.append(part.data(), static_cast<std::size_t>(count));
    }
    return received;
  }

 private:
  static constexpr int kMaxDescriptor = 1024;

  const int fd_;
};

}  // namespace plumescout::server
