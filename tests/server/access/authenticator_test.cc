// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/access/authenticator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "tests/server/token_line.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace authenticator_test {

constexpr char kAlice[] = "CN=alice,OU=operator,O=acme";
constexpr char kLocalPeer[] = "ipv4:127.0.0.1:4711";
constexpr char kFarPeer[] = "ipv4:10.0.0.7:4711";
const Principal kAliceAtAcme = {"alice", "acme", Role::kOperator, false};
const absl::Time kNow = absl::FromUnixSeconds(1'800'000'000);

MATCHER_P(Is, principal, "") {
  *result_listener << arg.status();
  return arg.ok() && *arg == principal;
}
MATCHER(IsTurnedAway, "") { return absl::IsUnauthenticated(arg.status()); }

class AuthenticatorTest : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(tokens_) << TokenLine("secret", "bob viewer acme never")
                           << TokenLine("old", "bob viewer acme 2001-01-01T00:00:00Z");
  }
  absl::StatusOr<Principal> Identify(const AccessConfig& config, CallCredentials credentials,
                                     bool local = false) {
    const auto authenticator = Authenticator::Make(config, local, [] { return kNow; });
    EXPECT_TRUE(authenticator.ok()) << authenticator.status();
    if (credentials.peer.empty()) credentials.peer = kFarPeer;
    return (*authenticator)->Identify(credentials);
  }
  AccessConfig Tokens() const {
    AccessConfig config;
    config.tokens_file = tokens_;
    return config;
  }
  static AccessConfig Front(const std::string& front) {
    AccessConfig config;
    config.trusted_front = front;
    return config;
  }

  TempFolder folder_;
  const std::string tokens_ = folder_.File("tokens");
  const Principal bob_ = {"bob", "acme", Role::kViewer, false};
};

TEST_F(AuthenticatorTest, WhereNothingIsConfiguredLocalCallersAreAdmins) {
  EXPECT_THAT(Identify({}, {}, /*local=*/true), Is(Principal{}));
  EXPECT_THAT(Identify({}, {}, /*local=*/false), IsTurnedAway());
  AccessConfig config;
  config.client_ca_file = "ca";
  EXPECT_THAT(Identify(Tokens(), {}, /*local=*/true), IsTurnedAway());
  EXPECT_THAT(Identify(config, {}, /*local=*/true), IsTurnedAway());
  EXPECT_THAT(Identify(Front("loopback"), {}, /*local=*/true), IsTurnedAway());
}

TEST_F(AuthenticatorTest, EverybodyIsAnAdminIfThatIsAskedFor) {
  AccessConfig config = Tokens();
  config.allow_anonymous = true;
  EXPECT_THAT(Identify(config, {}), Is(Principal{}));
  EXPECT_THAT(Identify(config, {.authorizations = {"Bearer secret"}}), Is(bob_));
  EXPECT_THAT(Identify(config, {.authorizations = {"Bearer wrong"}}), IsTurnedAway());
}

TEST_F(AuthenticatorTest, TokensAreLookedUp) {
  EXPECT_THAT(Identify(Tokens(), {.authorizations = {"Bearer secret"}}), Is(bob_));
  EXPECT_THAT(Identify(Tokens(), {.authorizations = {"bearer secret"}}), Is(bob_));
  for (const char* wrong : {"Bearer old", "Bearer no", "Bearer ", "Basic secret", "secret", ""}) {
    EXPECT_THAT(Identify(Tokens(), {.authorizations = {wrong}}), IsTurnedAway()) << wrong;
  }
  EXPECT_THAT(Identify(Tokens(), {.authorizations = {"Bearer secret", "Bearer secret"}}),
              IsTurnedAway());
  EXPECT_THAT(Identify({}, {.authorizations = {"Bearer secret"}}, /*local=*/true), IsTurnedAway());
}

// A token that is not good is not made up for by a certificate that is.
TEST_F(AuthenticatorTest, AWrongTokenIsNotPassedOver) {
  EXPECT_THAT(
      Identify(Tokens(), {.authorizations = {"Bearer wrong"}, .certificate_subject = kAlice}),
      IsTurnedAway());
  EXPECT_THAT(
      Identify(Tokens(), {.authorizations = {"Bearer secret"}, .certificate_subject = kAlice}),
      Is(bob_));
}

TEST_F(AuthenticatorTest, CertificatesSayWhoCalls) {
  EXPECT_THAT(Identify({}, {.certificate_subject = kAlice}), Is(kAliceAtAcme));
  EXPECT_THAT(Identify({}, {.certificate_subject = "CN=alice"}, /*local=*/true), IsTurnedAway());
  EXPECT_THAT(Identify({}, {.certificate_subject = ""}, /*local=*/true), IsTurnedAway());
}

TEST_F(AuthenticatorTest, WhatTheFrontSaysHolds) {
  EXPECT_THAT(Identify(Front("loopback"), {.peer = kLocalPeer, .forwarded_subjects = {kAlice}}),
              Is(kAliceAtAcme));
  EXPECT_THAT(Identify(Front("unix"), {.peer = "unix:", .forwarded_subjects = {kAlice}}),
              Is(kAliceAtAcme));
  EXPECT_THAT(Identify(Front("front"),
                       {.forwarded_subjects = {kAlice}, .certificate_subject = "CN=front,O=acme"}),
              Is(kAliceAtAcme));
}

TEST_F(AuthenticatorTest, WhatAnybodyElseSaysIsRefused) {
  const CallCredentials far{.peer = kFarPeer, .forwarded_subjects = {kAlice}};
  const CallCredentials near{.peer = kLocalPeer, .forwarded_subjects = {kAlice}};
  EXPECT_THAT(Identify({}, near, /*local=*/true), IsTurnedAway());
  EXPECT_THAT(Identify(Front("loopback"), far), IsTurnedAway());
  EXPECT_THAT(Identify(Front("unix"), near), IsTurnedAway());
  EXPECT_THAT(Identify(Front("front"), near), IsTurnedAway());
  CallCredentials liar = far;
  liar.certificate_subject = "CN=mallory,OU=viewer,O=front";
  EXPECT_THAT(Identify(Front("front"), liar), IsTurnedAway());
  liar.certificate_subject = "CN=front,CN=mallory";
  EXPECT_THAT(Identify(Front("front"), liar), IsTurnedAway());
  AccessConfig open;
  open.allow_anonymous = true;
  EXPECT_THAT(Identify(open, far), IsTurnedAway());
}

TEST_F(AuthenticatorTest, TheFrontItselfIsNobody) {
  EXPECT_THAT(Identify(Front("front"), {.certificate_subject = "CN=front,OU=admin"}),
              IsTurnedAway());
  EXPECT_THAT(Identify(Front("loopback"), {.peer = kLocalPeer}), IsTurnedAway());
  EXPECT_THAT(
      Identify(Front("loopback"), {.peer = kLocalPeer, .forwarded_subjects = {kAlice, kAlice}}),
      IsTurnedAway());
  EXPECT_THAT(Identify(Front("loopback"), {.peer = kLocalPeer, .forwarded_subjects = {""}}),
              IsTurnedAway());
}

TEST_F(AuthenticatorTest, CallersBehindTheFrontMayHaveTokens) {
  AccessConfig config = Tokens();
  config.trusted_front = "loopback";
  EXPECT_THAT(Identify(config, {.peer = kLocalPeer, .authorizations = {"Bearer secret"}}),
              Is(bob_));
}

TEST_F(AuthenticatorTest, AFileOfTokensThatIsNotThereIsRefused) {
  AccessConfig config;
  config.tokens_file = folder_.File("none");
  EXPECT_TRUE(absl::IsNotFound(Authenticator::Make(config, true).status()));
}

}  // namespace authenticator_test
}  // namespace plumescout::server
