// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/credentials.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/grpc_planner_client.h"
#include "server/server.h"
#include "tests/server/certificates.h"
#include "tests/server/token_line.h"

namespace plumescout::client {
namespace credentials_test {

using ::testing::HasSubstr;

std::string Refusal(const Credentials& credentials) {
  return std::string(CheckCredentials(credentials).message());
}

TEST(CredentialsTest, FilesGoTogetherAndAreThere) {
  const TempFolder folder;
  const std::string file = folder.File("file");
  std::ofstream(file) << "\n";
  EXPECT_EQ(Refusal({}), "");
  EXPECT_EQ(Refusal({.tls_ca_file = file}), "");
  EXPECT_THAT(Refusal({.tls_ca_file = file, .tls_certificate_file = file}), HasSubstr("its key"));
  EXPECT_THAT(Refusal({.tls_certificate_file = file, .tls_key_file = file}),
              HasSubstr("authority"));
  EXPECT_THAT(Refusal({.tls_ca_file = folder.File("none")}), HasSubstr("cannot be read"));
  EXPECT_THAT(Refusal({.token_file = folder.File("none")}), HasSubstr("cannot be read"));
  EXPECT_THAT(Refusal({.token_file = file}), HasSubstr("holds no token"));
}

class ServerByCredentialsTest : public testing::Test {
 protected:
  void Start(const server::AccessConfig& access) {
    server::ServerConfig config;
    config.listen = "127.0.0.1:0";
    config.access = access;
    auto server = server::Server::Start(config);
    ASSERT_TRUE(server.ok()) << server.status();
    server_ = *std::move(server);
  }
  server::AccessConfig Tls() const {
    server::AccessConfig access;
    access.tls_certificate_file = certificates_.File("host.crt");
    access.tls_key_file = certificates_.File("host.key");
    return access;
  }
  std::string Target() const { return absl::StrCat("127.0.0.1:", server_->port()); }
  // The client's first call.
  absl::Status CreateMission(const Credentials& credentials) {
    const auto client = MakeGrpcPlannerClient(
        {.target = Target(), .credentials = credentials, .call_timeout = absl::Seconds(60)});
    return client->CreateMission("attic", {});
  }
  void SetUp() override {
    certificates_.Make("server host");
    std::ofstream(tokens_) << server::TokenLine("secret", "scout operator - never");
    std::ofstream(token_) << "secret\n";
  }

  const server::Certificates certificates_;
  const std::string tokens_ = certificates_.File("tokens");
  const std::string token_ = certificates_.File("token");
  std::unique_ptr<server::Server> server_;
};

TEST_F(ServerByCredentialsTest, TheTokenGoesWithEveryCall) {
  server::AccessConfig access;
  access.tokens_file = tokens_;
  Start(access);
  EXPECT_TRUE(absl::IsUnauthenticated(CreateMission({})));
  EXPECT_EQ(CreateMission({.token_file = token_}), absl::OkStatus());
  const auto client = MakeGrpcPlannerClient({.target = Target(),
                                             .credentials = {.token_file = token_},
                                             .call_timeout = absl::Seconds(60),
                                             .stream_open_timeout = absl::Seconds(60)});
  const auto session = client->RegisterRobot("attic", "scout", 0.2, /*take_over=*/false);
  ASSERT_TRUE(session.ok()) << session.status();
  EXPECT_EQ(client->OpenObservationStream(*session).status(), absl::OkStatus());
  std::ofstream(token_) << "another\n";
  EXPECT_TRUE(absl::IsUnauthenticated(CreateMission({.token_file = token_})));
}

TEST_F(ServerByCredentialsTest, TokensGoOverTlsToo) {
  server::AccessConfig access = Tls();
  access.tokens_file = tokens_;
  Start(access);
  EXPECT_EQ(CreateMission({.tls_ca_file = certificates_.File("ca.crt"), .token_file = token_}),
            absl::OkStatus());
}

TEST_F(ServerByCredentialsTest, AClientShowsItsCertificate) {
  certificates_.Make("client scout operator");
  server::AccessConfig access = Tls();
  access.client_ca_file = certificates_.File("ca.crt");
  access.require_client_certificate = true;
  Start(access);
  EXPECT_EQ(CreateMission({.tls_ca_file = certificates_.File("ca.crt"),
                           .tls_certificate_file = certificates_.File("scout.crt"),
                           .tls_key_file = certificates_.File("scout.key")}),
            absl::OkStatus());
}

TEST_F(ServerByCredentialsTest, AServerOfAnotherAuthorityIsNotSpokenTo) {
  const server::Certificates strangers;
  Start(Tls());
  const auto client =
      MakeGrpcPlannerClient({.target = Target(),
                             .credentials = {.tls_ca_file = strangers.File("ca.crt")},
                             .call_timeout = absl::Milliseconds(300)});  // it would try for ever
  EXPECT_FALSE(client->CreateMission("attic", {}).ok());
}

TEST_F(ServerByCredentialsTest, CredentialsThatCannotBeReadFailTheCalls) {
  Start({});
  EXPECT_FALSE(CreateMission({.tls_ca_file = certificates_.File("none")}).ok());
}

}  // namespace credentials_test
}  // namespace plumescout::client
