// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/observe/http_endpoints.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "tests/server/http_client.h"

namespace plumescout::server {
namespace http_endpoints_test {

using ::testing::HasSubstr;

class HttpEndpointsTest : public testing::Test {
 protected:
  void SetUp() override {
    auto http = HttpEndpoints::Start("127.0.0.1:0", {[] { return "a_metric 1\n"; },
                                                     [this] { return ready_ ? "" : "draining"; }});
    ASSERT_TRUE(http.ok()) << http.status();
    http_ = *std::move(http);
  }
  int port() const { return http_->port(); }

  std::atomic<bool> ready_ = true;
  std::unique_ptr<HttpEndpoints> http_;
};

TEST_F(HttpEndpointsTest, MetricsAreText) {
  const HttpAnswer answer = HttpGet(port(), "/metrics");
  EXPECT_EQ(answer.code, 200);
  EXPECT_THAT(answer.head, HasSubstr("Content-Type: text/plain; version=0.0.4"));
  EXPECT_EQ(answer.body, "a_metric 1\n");
}

TEST_F(HttpEndpointsTest, ReadinessComesAndGoes) {
  EXPECT_EQ(HttpGet(port(), "/readyz").code, 200);
  ready_ = false;
  EXPECT_EQ(HttpGet(port(), "/readyz").code, 503);
  EXPECT_EQ(HttpGet(port(), "/healthz").code, 200);
}

TEST_F(HttpEndpointsTest, NothingElseIsServed) {
  for (const char* path : {"/", "/metrics/", "/metrics/x", "/../etc/passwd", "/etc/passwd"}) {
    EXPECT_NE(HttpGet(port(), path).code, 200) << path;
  }
  for (const char* method : {"POST", "PUT", "DELETE"}) {
    EXPECT_EQ(HttpGet(port(), "/metrics", method).code, 405) << method;
  }
}

TEST_F(HttpEndpointsTest, LargeAndSenselessRequestsAreRefused) {
  const std::string large = "GET /metrics HTTP/1.1\r\nx: " + std::string(10'000, 'x') + "\r\n\r\n";
  EXPECT_THAT(HttpExchange(port(), large), ::testing::Not(HasSubstr("a_metric")));
  EXPECT_THAT(HttpExchange(port(), std::string("\0\xff\r\n\r\n", 6)),
              ::testing::Not(HasSubstr("a_metric")));
  EXPECT_EQ(HttpGet(port(), "/metrics").code, 200);
}

TEST_F(HttpEndpointsTest, WhoSaysNothingIsSentAwayAndHoldsUpNobody) {
  std::vector<std::future<std::string>> silent;
  for (int i = 0; i < 40; ++i) {  // more than are served at a time
    silent.push_back(std::async(std::launch::async, [&] { return HttpExchange(port(), ""); }));
  }
  EXPECT_EQ(HttpGet(port(), "/metrics").code, 200);
  // Each returns once the other side has closed.
  for (std::future<std::string>& answer : silent) EXPECT_EQ(answer.get(), "");
  EXPECT_EQ(HttpGet(port(), "/metrics").code, 200);
}

TEST_F(HttpEndpointsTest, RequestMayComeInParts) {
  const HttpAnswer whole = HttpGet(port(), "/readyz?verbose");
  EXPECT_EQ(whole.code, 200);
  EXPECT_THAT(HttpExchange(port(), "GET /readyz HTTP/1.1\r\n\r\n"), HasSubstr("200 OK"));
  EXPECT_EQ(HttpExchange(port(), "GET /readyz HTTP/1.1\r\n"), "");
}

TEST_F(HttpEndpointsTest, AddressThatCannotBeHadIsAnError) {
  const HttpSources sources{[] { return ""; }, [] { return ""; }};
  for (const std::string& address :
       {absl::StrCat("127.0.0.1:", port()), std::string("no such host:1")}) {
    const absl::Status refused = HttpEndpoints::Start(address, sources).status();
    EXPECT_TRUE(absl::IsUnavailable(refused)) << refused;
    EXPECT_THAT(std::string(refused.message()), HasSubstr(address));
  }
}

}  // namespace http_endpoints_test
}  // namespace plumescout::server
