// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/address.h"

#include <gtest/gtest.h>

namespace plumescout::server {
namespace address_test {

TEST(AddressTest, LoopbackUnixSocketsAndNothingAreLocal) {
  for (const char* listen : {"127.0.0.1:50551", "127.1.2.3:0", "localhost:1", "[::1]:0", "",
                             "unix:/run/plumescout.sock", "unix-abstract:plumescout"}) {
    EXPECT_TRUE(IsLocalAddress(listen)) << listen;
  }
}

TEST(AddressTest, WhateverElseCanBeReached) {
  for (const char* listen :
       {"0.0.0.0:50551", "[::]:50551", "10.0.0.1:1", "128.0.0.1:1", "example.org:1", ":50551",
        "localhost.example.org:1", "[::ffff:10.0.0.1]:1", "127.0.0.1.example.org:1"}) {
    EXPECT_FALSE(IsLocalAddress(listen)) << listen;
  }
}

TEST(AddressTest, PeersAreJudgedAsGrpcWritesThem) {
  for (const char* peer : {"ipv4:127.0.0.1:4711", "ipv6:%5B::1%5D:4711", "ipv6:[::1]:4711",
                           "unix:", "unix:/run/a", "inproc", "unknown"}) {
    EXPECT_TRUE(IsLocalPeer(peer)) << peer;
  }
  for (const char* peer : {"ipv4:10.0.0.7:4711", "ipv6:%5Bfe80::1%5D:4711", "127.0.0.1:1", "",
                           "dns:localhost", "inproc2"}) {
    EXPECT_FALSE(IsLocalPeer(peer)) << peer;
  }
}

TEST(AddressTest, HostAndPortAreTakenApart) {
  EXPECT_EQ(SplitHostPort("10.0.0.1:50551").host, "10.0.0.1");
  EXPECT_EQ(SplitHostPort("10.0.0.1:50551").port, "50551");
  EXPECT_EQ(SplitHostPort("[::1]:7").host, "::1");
  EXPECT_EQ(SplitHostPort("[::1]:7").port, "7");
  EXPECT_EQ(SplitHostPort("host").host, "host");
  EXPECT_EQ(SplitHostPort("host").port, "");
}

}  // namespace address_test
}  // namespace plumescout::server
