// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/web/grpc_web.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "plumescout/v1/map_service.grpc.pb.h"
#include "plumescout/v1/snapshot_service.grpc.pb.h"

namespace plumescout::server {
namespace grpc_web_test {

const std::string kTwoBytes("\0\0\0\0\2ab", 7);

TEST(GrpcWeb, MethodsWithOneRequestMayBeCalled) {
  const auto watch = FindWebMethod("/plumescout.v1.MapService/WatchMap");
  ASSERT_TRUE(watch.has_value());
  EXPECT_EQ(watch->path, "/plumescout.v1.MapService/WatchMap");
  EXPECT_TRUE(watch->is_stream);
  const auto get = FindWebMethod("/plumescout.v1.MapService/GetMap");
  ASSERT_TRUE(get.has_value());
  EXPECT_FALSE(get->is_stream);
}

TEST(GrpcWeb, OthersMayNot) {
  for (const char* path :
       {"", "/", "/plumescout.v1.MapService", "/plumescout.v1.MapService/Nothing",
        "/plumescout.v1.IngestService/StreamObservations",
        "/plumescout.v1.SnapshotService/ImportMission", "/grpc.health.v1.Health/Check",
        "plumescout.v1.MapService/GetMap"}) {
    EXPECT_EQ(FindWebMethod(path), std::nullopt) << path;
  }
}

TEST(GrpcWeb, BodyIsOneMessage) {
  EXPECT_EQ(MessageOfBody(kTwoBytes), "ab");
  EXPECT_EQ(MessageOfBody(std::string(5, '\0')), "");
  EXPECT_EQ(MessageOfBody(""), std::nullopt);
  EXPECT_EQ(MessageOfBody(kTwoBytes.substr(0, 6)), std::nullopt);
  EXPECT_EQ(MessageOfBody(kTwoBytes + "c"), std::nullopt);
  EXPECT_EQ(MessageOfBody("\1" + kTwoBytes.substr(1)), std::nullopt);  // compressed
}

TEST(GrpcWeb, MessagesHaveTheirLengthBeforeThem) {
  EXPECT_EQ(MessageFrame("ab"), kTwoBytes);
  const std::string large = MessageFrame(std::string(0x010203, 'x'));
  EXPECT_EQ(large.substr(0, 5), std::string("\0\0\1\2\3", 5));
}

TEST(GrpcWeb, TrailersTellTheStatus) {
  EXPECT_EQ(TrailerFrame(grpc::Status()), std::string("\x80\0\0\0\x10grpc-status: 0\r\n", 21));
  const std::string refused =
      TrailerFrame(grpc::Status(grpc::StatusCode::NOT_FOUND, "5 % of ä\r\n", "abc"));
  EXPECT_EQ(refused.substr(5),
            "grpc-status: 5\r\ngrpc-message: 5 %25 of %c3%a4%0d%0a\r\n"
            "grpc-status-details-bin: YWJj\r\n");
}

TEST(GrpcWeb, TimeoutsHaveUnits) {
  EXPECT_EQ(ParseGrpcTimeout("1500m"), absl::Milliseconds(1500));
  EXPECT_EQ(ParseGrpcTimeout("2S"), absl::Seconds(2));
  EXPECT_EQ(ParseGrpcTimeout("3M"), absl::Minutes(3));
  EXPECT_EQ(ParseGrpcTimeout("1H"), absl::Hours(1));
  EXPECT_EQ(ParseGrpcTimeout("7u"), absl::Microseconds(7));
  EXPECT_EQ(ParseGrpcTimeout("99999999n"), absl::Nanoseconds(99'999'999));
  EXPECT_EQ(ParseGrpcTimeout("24H"), absl::Hours(24));
  for (const char* text : {"25H", "99999999H", "99999999M", "86401S"}) {
    EXPECT_EQ(ParseGrpcTimeout(text), absl::Hours(24)) << text;
  }
  for (const char* text : {"", "m", "1", "-1S", "1.5S", "1s", "999999999n"}) {
    EXPECT_EQ(ParseGrpcTimeout(text), std::nullopt) << text;
  }
}

}  // namespace grpc_web_test
}  // namespace plumescout::server
