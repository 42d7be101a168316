// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"

namespace plumescout::server {

struct HttpAnswer {
  int code = 0;  // 0: none
  std::string head;
  std::string body;
};

// Sends bytes to a port of loopback and reads until the other side closes.
inline std::string HttpExchange(int port, const std::string& sent) {
  const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const timeval patience{60, 0};
  setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  EXPECT_EQ(send(fd, sent.data(), sent.size(), MSG_NOSIGNAL), static_cast<ssize_t>(sent.size()));
  std::string received;
  std::array<char, 4096> part{};
  for (ssize_t count = 0; (count = recv(fd, part.data(), part.size(), 0)) > 0;) {
    received.append(part.data(), static_cast<std::size_t>(count));
  }
  close(fd);
  return received;
}

inline HttpAnswer HttpGet(int port, const std::string& path, const std::string& method = "GET") {
  const std::string text = HttpExchange(
      port, absl::StrCat(method, " ", path, " HTTP/1.1\r\nHost: x\r\nContent-Length: 0\r\n\r\n"));
  HttpAnswer answer;
  const std::size_t end = text.find("\r\n\r\n");
  if (end == std::string::npos) return answer;
  answer.head = text.substr(0, end);
  answer.body = text.substr(end + 4);
  const std::size_t code = text.find(' ');
  if (!absl::SimpleAtoi(absl::string_view(text).substr(code + 1, 3), &answer.code)) answer.code = 0;
  return answer;
}

}  // namespace plumescout::server
