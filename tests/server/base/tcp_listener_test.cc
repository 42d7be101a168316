// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/tcp_listener.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

#include "absl/strings/str_cat.h"

namespace plumescout::server {
namespace tcp_listener_test {

using ::testing::HasSubstr;

TEST(TcpListener, FindsAFreePortThatNobodyElseGets) {
  const auto listener = ListenOnTcp("127.0.0.1:0");
  ASSERT_TRUE(listener.ok()) << listener.status();
  const int port = ListenerPort(*listener);
  EXPECT_GT(port, 0);
  const std::string address = absl::StrCat("127.0.0.1:", port);
  const absl::Status second = ListenOnTcp(address).status();
  EXPECT_TRUE(absl::IsUnavailable(second)) << second;
  EXPECT_THAT(std::string(second.message()), HasSubstr(address));
  close(*listener);
}

TEST(TcpListener, LocalhostIsLoopback) {
  const auto listener = ListenOnTcp("localhost:0");
  ASSERT_TRUE(listener.ok()) << listener.status();
  close(*listener);
}

TEST(TcpListener, NamesWhatIsNoAddress) {
  for (const char* address : {"", "127.0.0.1", "no such host:1", "127.0.0.1:http", "[::1"}) {
    const absl::Status refused = ListenOnTcp(address).status();
    EXPECT_TRUE(absl::IsUnavailable(refused)) << address;
    EXPECT_THAT(std::string(refused.message()), HasSubstr(address));
  }
}

TEST(TcpListener, WhatDoesNotListenHasNoPort) { EXPECT_EQ(ListenerPort(-1), 0); }

}  // namespace tcp_listener_test
}  // namespace plumescout::server
