// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/web/web_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/tcp.h>

#include <atomic>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "absl/strings/str_cat.h"
#include "server/web/grpc_web.h"
#include "server/web/http_message.h"
#include "tests/server/http_client.h"
#include "tests/server/http_connection.h"
#include "tests/server/service_fixture.h"
#include "tests/server/token_line.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace web_server_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr char kListMissions[] = "/plumescout.v1.MissionService/ListMissions";
constexpr char kWatchMap[] = "/plumescout.v1.MapService/WatchMap";
constexpr char kClose[] = "Connection: close\r\n";

std::string Post(const std::string& path, const std::string& message,
                 const std::string& headers = kClose) {
  const std::string body = MessageFrame(message);
  return absl::StrCat("POST ", path, " HTTP/1.1\r\nHost: localhost\r\nContent-Type: ", kGrpcWebType,
                      "\r\nContent-Length: ", body.size(), "\r\n", headers, "\r\n", body);
}

class WebServerTest : public ServiceTest {
 protected:
  void Serve(WebOptions options = {}, const ServerConfig& config = {}) {
    StartServer(config);
    ServeWeb(std::move(options));
  }
  void ServeWeb(WebOptions options) {
    auto web = WebServer::Start("127.0.0.1:0", server_->InProcessChannel(), std::move(options));
    ASSERT_TRUE(web.ok()) << web.status();
    web_ = *std::move(web);
  }
  std::string Exchange(const std::string& request) const {
    return HttpExchange(web_->port(), request);
  }
  static std::string WatchHall() {
    v1::WatchMapRequest request;
    request.set_mission("missions/hall");
    return Post(kWatchMap, request.SerializeAsString(), "");
  }

  std::unique_ptr<WebServer> web_;
};

TEST_F(WebServerTest, CallsAreAnswered) {
  Serve();
  const std::string answer = Exchange(Post(kListMissions, ""));
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200 OK\r\nContent-Type: application/grpc-web+proto"));
  EXPECT_THAT(answer, HasSubstr("missions/hall"));
  EXPECT_THAT(answer, ::testing::EndsWith("grpc-status: 0\r\n\r\n0\r\n\r\n"));
}

TEST_F(WebServerTest, OneConnectionCarriesSeveralRequests) {
  Serve();
  const std::string answers =
      Exchange(Post(kListMissions, "", "") + Post(kListMissions, "", "") + Post(kListMissions, ""));
  std::size_t count = 0;
  for (std::size_t at = answers.find("HTTP/1.1 200"); at != std::string::npos;
       at = answers.find("HTTP/1.1 200", at + 1)) {
    ++count;
  }
  EXPECT_EQ(count, 3U);
}

TEST_F(WebServerTest, WhatComesWhenTheServerIsAboutToEndIsRefused) {
  Serve();
  web_->RefuseCalls();
  const std::string answer = Exchange(Post(kListMissions, ""));
  EXPECT_THAT(answer, HasSubstr("grpc-status: 14\r\n"));
  EXPECT_THAT(answer, HasSubstr("DRAINING"));
}

TEST_F(WebServerTest, OnlyItsOwnPagesMayCall) {
  Serve();
  const auto with = [&](const std::string& headers) {
    return Exchange(Post(kListMissions, "", headers + kClose));
  };
  EXPECT_THAT(with("Origin: http://localhost\r\n"), StartsWith("HTTP/1.1 200"));
  for (const char* origin : {"http://evil.example", "null", "http://localhost:1"}) {
    EXPECT_THAT(with(absl::StrCat("Origin: ", origin, "\r\n")), StartsWith("HTTP/1.1 403"));
  }
  // A name of another host that leads here.
  for (const char* host : {"evil.example", "unix:1", "10.0.0.1"}) {
    EXPECT_THAT(Exchange(absl::StrCat("GET / HTTP/1.1\r\nHost: ", host, "\r\n", kClose, "\r\n")),
                StartsWith("HTTP/1.1 403"));
  }
}

TEST_F(WebServerTest, PagesOfAFrontMayCall) {
  WebOptions options;
  options.hosts = {"console.example"};
  Serve(std::move(options));
  const auto with = [&](const std::string& origin) {
    return Exchange(Post(kListMissions, "", absl::StrCat("Origin: ", origin, "\r\n", kClose)));
  };
  EXPECT_THAT(with("https://console.example"), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(with("http://localhost"), StartsWith("HTTP/1.1 200"));
  for (const char* origin : {"https://console.example:1", "https://x.console.example",
                             "https://console.example.evil", "console.example"}) {
    EXPECT_THAT(with(origin), StartsWith("HTTP/1.1 403")) << origin;
  }
  const auto at = [&](const std::string& host) {
    return Exchange(absl::StrCat("GET /x HTTP/1.1\r\nHost: ", host, "\r\n", kClose, "\r\n"));
  };
  EXPECT_THAT(at("console.example"), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(at("evil.example"), StartsWith("HTTP/1.1 403"));
}

TEST_F(WebServerTest, WhatIsNoCallIsRefused) {
  Serve();
  EXPECT_THAT(Exchange("POST / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"),
              StartsWith("HTTP/1.1 415"));
  EXPECT_THAT(Exchange(Post("/grpc.health.v1.Health/Check", "")), HasSubstr("grpc-status: 12\r\n"));
  EXPECT_THAT(Exchange("PUT / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"),
              StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(Exchange("nonsense\r\n\r\n"), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(Exchange(Post(kListMissions, "", "Authorization: \xff\r\nConnection: close\r\n")),
              HasSubstr("grpc-status: 3\r\n"));
}

TEST_F(WebServerTest, MessagesAreBounded) {
  WebOptions options;
  options.max_message_bytes = 100;
  Serve(std::move(options));
  EXPECT_THAT(Exchange(Post(kListMissions, std::string(101, 'x'))), StartsWith("HTTP/1.1 413"));
}

TEST_F(WebServerTest, RefusalsArriveWhateverIsStillOnItsWay) {
  WebOptions options;
  options.max_message_bytes = 100;
  Serve(std::move(options));
  const std::string answer = Exchange(Post(kListMissions, std::string(1 << 20, 'x')));
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 413"));
  EXPECT_THAT(answer, ::testing::EndsWith("the body is too large\n"));
}

TEST_F(WebServerTest, CallsHaveTheIdentityOfTheirTokens) {
  const TempFolder folder;
  const std::string path = folder.File("tokens");
  std::ofstream(path) << TokenLine("secret", "lena viewer acme never");
  ServerConfig config;
  config.access.tokens_file = path;
  config.listen = "127.0.0.1:0";
  auto server = Server::Start(config);
  ASSERT_TRUE(server.ok()) << server.status();
  server_ = *std::move(server);
  ServeWeb({});
  EXPECT_THAT(Exchange(Post(kListMissions, "")), HasSubstr("grpc-status: 16\r\n"));
  const std::string who = absl::StrCat("Authorization: Bearer secret\r\n", kClose);
  EXPECT_THAT(Exchange(Post(kListMissions, "", who)), HasSubstr("grpc-status: 0\r\n"));
  EXPECT_THAT(Exchange(Post("/plumescout.v1.MissionService/CreateMission", "", who)),
              HasSubstr("grpc-status: 7\r\n"));
}

TEST_F(WebServerTest, CallsHaveTheIdentityThatTheFrontSays) {
  ServerConfig config;
  config.access.trusted_front = kLocalFront;
  config.listen = "127.0.0.1:0";
  auto server = Server::Start(config);
  ASSERT_TRUE(server.ok()) << server.status();
  server_ = *std::move(server);
  const std::string who =
      absl::StrCat("X-PlumeScout-Subject: CN=lena,OU=viewer,O=acme\r\n", kClose);
  WebOptions options;
  options.takes_subjects = true;
  ServeWeb(std::move(options));
  EXPECT_THAT(Exchange(Post(kListMissions, "", who)), HasSubstr("grpc-status: 0\r\n"));
  EXPECT_THAT(Exchange(Post("/plumescout.v1.MissionService/CreateMission", "", who)),
              HasSubstr("grpc-status: 7\r\n"));
  ServeWeb({});  // where anybody may connect, nobody is believed
  EXPECT_THAT(Exchange(Post(kListMissions, "", who)), HasSubstr("grpc-status: 16\r\n"));
}

TEST_F(WebServerTest, TooManyStreamsAreRefusedUntilOneEnds) {
  WebOptions options;
  options.max_streams = 1;
  Serve(std::move(options));
  auto first = std::make_unique<HttpConnection>(web_->port());
  first->Send(WatchHall());
  first->ReadTo("\r\n\r\n");
  const HttpConnection second(web_->port());
  second.Send(WatchHall());
  EXPECT_THAT(second.ReadTo("grpc-message"), HasSubstr("grpc-status: 8\r\n"));
  EXPECT_THAT(Exchange(Post(kListMissions, "")), HasSubstr("grpc-status: 0\r\n"));
  first = nullptr;
  // The server hears of that before, or in the same turn as, of what comes later.
  const HttpConnection third(web_->port());
  third.Send(WatchHall());
  EXPECT_THAT(third.ReadTo("\r\n\r\n"), HasSubstr("Transfer-Encoding: chunked"));
}

TEST_F(WebServerTest, StreamsEndWhenTheServerDrains) {
  Serve();
  const HttpConnection client(web_->port());
  client.Send(WatchHall());
  client.ReadTo("\r\n\r\n");
  server_->Drain();
  EXPECT_THAT(client.ReadTo("grpc-status"), HasSubstr("grpc-status"));
}

TEST_F(WebServerTest, VanishedPeersAreNoticed) {
  Serve();
  const HttpConnection client(web_->port());
  client.Send(WatchHall());
  client.ReadTo("\r\n\r\n");  // it was accepted
  EXPECT_EQ(client.OptionOfPeer(SOL_SOCKET, SO_KEEPALIVE), 1);
  EXPECT_EQ(client.OptionOfPeer(IPPROTO_TCP, TCP_KEEPIDLE), 30);
  EXPECT_EQ(client.OptionOfPeer(IPPROTO_TCP, TCP_KEEPCNT), 3);
  EXPECT_EQ(client.OptionOfPeer(IPPROTO_TCP, TCP_USER_TIMEOUT), 60'000);
  EXPECT_EQ(client.OptionOfPeer(IPPROTO_TCP, TCP_NODELAY), 1);
}

// A folder with this page.
StaticFiles PageOf(const std::string& content) {
  const TempFolder folder;
  std::ofstream(folder.File("index.html")) << content;
  const auto files = StaticFiles::Load(folder.path());
  EXPECT_TRUE(files.ok()) << files.status();
  return files.ok() ? *files : StaticFiles();
}

constexpr char kGetPage[] = "GET / HTTP/1.1\r\nHost: 127.0.0.1:8080\r\nConnection: close\r\n\r\n";

TEST_F(WebServerTest, PagesAreServed) {
  WebOptions options;
  options.files = PageOf("<p>console");
  Serve(std::move(options));
  const std::string get = kGetPage;
  EXPECT_THAT(Exchange(get), ::testing::EndsWith("\r\n\r\n<p>console"));
  EXPECT_THAT(Exchange("HEAD" + get.substr(3)), ::testing::EndsWith("Content-Length: 10\r\n\r\n"));
  EXPECT_THAT(Exchange("GET /x" + get.substr(5)), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(Exchange("HEAD /x" + get.substr(5)),
              ::testing::EndsWith("Content-Length: 13\r\n\r\n"));  // no such file, and a line end
}

TEST_F(WebServerTest, WhoDoesNotReadHoldsUpNobody) {
  const std::string large(std::size_t{16} << 20, 'x');  // more than sockets hold
  WebOptions options;
  options.files = PageOf(large);
  Serve(std::move(options));
  const HttpConnection stalled(web_->port());
  stalled.Send(kGetPage);
  EXPECT_THAT(Exchange(Post(kListMissions, "")), HasSubstr("grpc-status: 0\r\n"));
  EXPECT_THAT(Exchange(kGetPage), ::testing::EndsWith(large));
}

TEST_F(WebServerTest, AnswersHaveOneTimeLimitHoweverTheyAreRead) {
  const std::string large(std::size_t{16} << 20, 'x');  // more than sockets hold
  WebOptions options;
  options.files = PageOf(large);
  options.answer_patience = absl::ZeroDuration();
  options.reader_patience = absl::InfiniteDuration();
  Serve(std::move(options));
  const HttpConnection slow(web_->port());
  slow.Send(kGetPage);
  // Each comes to its turn after the page has had one.
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(Exchange(Post(kListMissions, "")), HasSubstr("grpc-status: 0\r\n"));
  }
  EXPECT_LT(slow.CountToEnd(), large.size());
}

TEST_F(WebServerTest, ThereAreAsManyConnectionsAsStreamsAndCalls) {
  WebOptions options;
  options.max_streams = 1;
  options.max_calls = 0;
  options.max_spare_connections = 0;
  Serve(std::move(options));
  const HttpConnection stream(web_->port());
  stream.Send(WatchHall());
  EXPECT_THAT(stream.ReadTo("\r\n\r\n"), HasSubstr("200 OK"));
  const HttpConnection other(web_->port());
  EXPECT_EQ(other.CountToEnd(), 0U);
}

// Sends requests without waiting for their answers, and does not end by itself.
class Flood {
 public:
  explicit Flood(int port)
      : client_(port),
        reader_([this] { answered_bytes_ = client_.CountToEnd(); }),
        sender_([this] { Send(); }) {}
  ~Flood() { End(); }
  Flood(const Flood&) = delete;
  Flood& operator=(const Flood&) = delete;

  void AwaitMegabyte() const {
    for (std::int64_t sent = 0; sent < kMegabyte / kSize;) {
      sent_.wait(sent);
      sent = sent_;
    }
  }
  void End() {
    ended_ = true;
    if (sender_.joinable()) sender_.join();
    if (reader_.joinable()) reader_.join();
  }
  std::int64_t sent() const { return sent_; }
  std::size_t answered_bytes() const { return answered_bytes_; }

  static constexpr char kGet[] = "GET /nothing HTTP/1.1\r\nHost: localhost\r\n\r\n";

 private:
  static constexpr std::int64_t kMegabyte = 1 << 20;
  static constexpr std::int64_t kSize = sizeof(kGet) - 1;
  static constexpr int kBatch = 1000;

  void Send() {
    std::string batch;
    for (int i = 0; i < kBatch; ++i) batch += kGet;
    while (!ended_ && client_.TrySend(batch)) {
      sent_ += kBatch;
      sent_.notify_all();
    }
    client_.EndSending();
  }

  const HttpConnection client_;
  std::atomic<bool> ended_ = false;
  std::atomic<std::int64_t> sent_ = 0;
  std::size_t answered_bytes_ = 0;
  std::thread reader_;  // last: they use all of the above
  std::thread sender_;
};

TEST_F(WebServerTest, WhoAsksWithoutEndHoldsUpNobody) {
  Serve();
  const std::string answer = HttpRefusal(404, "no such file");
  Flood flood(web_->port());
  flood.AwaitMegabyte();
  EXPECT_THAT(Exchange(Post(kListMissions, "")), HasSubstr("grpc-status: 0\r\n"));
  flood.End();
  EXPECT_EQ(flood.answered_bytes(), static_cast<std::size_t>(flood.sent()) * answer.size());
}

TEST_F(WebServerTest, WhoAsksWithoutEndDoesNotKeepItFromStopping) {
  Serve();
  const Flood flood(web_->port());
  flood.AwaitMegabyte();
  web_ = nullptr;
}

TEST_F(WebServerTest, WithoutPagesItSaysSo) {
  Serve();
  EXPECT_THAT(Exchange("GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"),
              HasSubstr("--http-root"));
}

TEST_F(WebServerTest, AddressThatCannotBeHadIsAnError) {
  Serve();
  const absl::Status refused =
      WebServer::Start(absl::StrCat("127.0.0.1:", web_->port()), server_->InProcessChannel(), {})
          .status();
  EXPECT_TRUE(absl::IsUnavailable(refused)) << refused;
}

}  // namespace web_server_test
}  // namespace plumescout::server
