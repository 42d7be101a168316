// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/access/server_credentials.h"

#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <openssl/bn.h>
#include <openssl/err.h>
#include <openssl/ssl.h>

#include <fstream>
#include <memory>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "plumescout/v1/mission_service.grpc.pb.h"
#include "server/server.h"
#include "tests/server/certificates.h"
#include "tests/server/service_clients.h"

namespace plumescout::server {
namespace server_credentials_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr char kSubjectKey[] = "x-plumescout-subject";
constexpr char kAlice[] = "CN=alice,OU=operator,O=acme";

// What a TLS handshake with the server comes to, and the server's certificate.
struct Handshake {
  bool done = false;
  int version = 0;
  int refusal = 0;  // OpenSSL's reason
  std::string serial;
};

Handshake ShakeHands(int port, int version) {
  const std::unique_ptr<SSL_CTX, void (*)(SSL_CTX*)> context(SSL_CTX_new(TLS_client_method()),
                                                             SSL_CTX_free);
  SSL_CTX_set_security_level(context.get(), 0);  // else this side would not speak old versions
  SSL_CTX_set_min_proto_version(context.get(), version);
  SSL_CTX_set_max_proto_version(context.get(), version);
  constexpr unsigned char kH2[] = {2, 'h', '2'};
  SSL_CTX_set_alpn_protos(context.get(), kH2, sizeof(kH2));
  const std::unique_ptr<BIO, void (*)(BIO*)> link(BIO_new_ssl_connect(context.get()), BIO_free_all);
  BIO_set_conn_hostname(link.get(), absl::StrCat("127.0.0.1:", port).c_str());
  ERR_clear_error();
  Handshake result;
  result.done = BIO_do_handshake(link.get()) == 1;
  if (!result.done) result.refusal = ERR_GET_REASON(ERR_peek_last_error());
  SSL* tls = nullptr;
  BIO_get_ssl(link.get(), &tls);
  if (!result.done || tls == nullptr) return result;
  result.version = SSL_version(tls);
  const std::unique_ptr<X509, void (*)(X509*)> peer(SSL_get1_peer_certificate(tls), X509_free);
  if (peer == nullptr) return result;
  const std::unique_ptr<BIGNUM, void (*)(BIGNUM*)> number(
      ASN1_INTEGER_to_BN(X509_get0_serialNumber(peer.get()), nullptr), BN_free);
  const std::unique_ptr<char, void (*)(char*)> hex(BN_bn2hex(number.get()),
                                                   [](char* text) { OPENSSL_free(text); });
  result.serial = hex.get();
  return result;
}

class ServerCredentialsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    certificates_ = std::make_unique<Certificates>();
    strangers_ = std::make_unique<Certificates>();  // an authority of the same name
    certificates_->Make("server host");
    certificates_->Make("client alice operator acme");
    certificates_->Make("client front viewer");
    certificates_->Make("client late operator acme --days -1");
    strangers_->Make("client alice operator acme");
  }
  static void TearDownTestSuite() {
    certificates_.reset();
    strangers_.reset();
  }

  static AccessConfig Tls(bool client_certificates) {
    AccessConfig config;
    config.tls_certificate_file = certificates_->File("host.crt");
    config.tls_key_file = certificates_->File("host.key");
    if (!client_certificates) return config;
    config.client_ca_file = certificates_->File("ca.crt");
    config.require_client_certificate = true;
    return config;
  }
  void Start(const AccessConfig& access) {
    ServerConfig config;
    config.listen = "127.0.0.1:0";
    config.access = access;
    ASSERT_EQ(Validate(config), absl::OkStatus());
    auto server = Server::Start(config);
    ASSERT_TRUE(server.ok()) << server.status();
    server_ = *std::move(server);
  }
  // Creates a mission by the client of that certificate; "" for none. Says whose it is.
  absl::StatusOr<std::string> CreateMission(const Certificates& from, const std::string& client,
                                            const std::string& forwarded = "") {
    grpc::SslCredentialsOptions options;
    options.pem_root_certs = certificates_->Text("ca.crt");
    if (!client.empty()) {
      options.pem_cert_chain = from.Text(client + ".crt");
      options.pem_private_key = from.Text(client + ".key");
    }
    return CreateMission(grpc::SslCredentials(options), forwarded);
  }
  absl::StatusOr<std::string> CreateMission(
      const std::shared_ptr<grpc::ChannelCredentials>& credentials,
      const std::string& forwarded = "") {
    const auto channel =
        grpc::CreateChannel(absl::StrCat("127.0.0.1:", server_->port()), credentials);
    grpc::ClientContext context;
    SetPatience(context);
    if (!forwarded.empty()) context.AddMetadata(kSubjectKey, forwarded);
    v1::CreateMissionRequest request;
    request.set_mission_id("attic");
    v1::CreateMissionResponse response;
    const absl::Status status =
        ToAbsl(v1::MissionService::NewStub(channel)->CreateMission(&context, request, &response));
    if (!status.ok()) return status;
    return response.mission().owner();
  }

  static std::unique_ptr<Certificates> certificates_;
  static std::unique_ptr<Certificates> strangers_;
  std::unique_ptr<Server> server_;
};
std::unique_ptr<Certificates> ServerCredentialsTest::certificates_;
std::unique_ptr<Certificates> ServerCredentialsTest::strangers_;

TEST_F(ServerCredentialsTest, ACertificateOfTheAuthorityLetsIn) {
  Start(Tls(true));
  const auto owner = CreateMission(*certificates_, "alice");
  ASSERT_TRUE(owner.ok()) << owner.status();
  EXPECT_EQ(*owner, "alice");
}

TEST_F(ServerCredentialsTest, NoOtherCertificateDoes) {
  Start(Tls(true));
  EXPECT_TRUE(absl::IsUnavailable(CreateMission(*certificates_, "").status()));
  EXPECT_TRUE(absl::IsUnavailable(CreateMission(*strangers_, "alice").status()));
  EXPECT_TRUE(absl::IsUnavailable(CreateMission(*certificates_, "late").status()));
  EXPECT_TRUE(absl::IsUnavailable(CreateMission(grpc::InsecureChannelCredentials()).status()));
  EXPECT_TRUE(CreateMission(*certificates_, "alice").ok());
}

// A certificate may be left out, but a wrong one is not passed over.
TEST_F(ServerCredentialsTest, CertificatesThatAreOptionalAreStillVerified) {
  AccessConfig access = Tls(true);
  access.require_client_certificate = false;
  Start(access);
  EXPECT_TRUE(absl::IsUnauthenticated(CreateMission(*certificates_, "").status()));
  EXPECT_TRUE(absl::IsUnavailable(CreateMission(*strangers_, "alice").status()));
  EXPECT_TRUE(absl::IsUnavailable(CreateMission(*certificates_, "late").status()));
  EXPECT_TRUE(CreateMission(*certificates_, "alice").ok());
}

TEST_F(ServerCredentialsTest, TheFrontIsKnownByItsCertificate) {
  AccessConfig access = Tls(true);
  access.trusted_front = "front";
  Start(access);
  EXPECT_TRUE(absl::IsUnauthenticated(CreateMission(*certificates_, "front").status()));
  EXPECT_TRUE(
      absl::IsUnauthenticated(CreateMission(*certificates_, "alice", "CN=root,OU=admin").status()));
  EXPECT_EQ(*CreateMission(*certificates_, "front", kAlice), "alice");
}

TEST_F(ServerCredentialsTest, OldVersionsOfTlsAreRefused) {
  Start(Tls(false));
  for (const int version : {TLS1_VERSION, TLS1_1_VERSION}) {
    const Handshake handshake = ShakeHands(server_->port(), version);
    EXPECT_FALSE(handshake.done);
    EXPECT_EQ(handshake.refusal, SSL_R_UNEXPECTED_EOF_WHILE_READING);  // the server hangs up
  }
  for (const int version : {TLS1_2_VERSION, TLS1_3_VERSION}) {
    const Handshake handshake = ShakeHands(server_->port(), version);
    EXPECT_TRUE(handshake.done);
    EXPECT_EQ(handshake.version, version);
  }
}

TEST_F(ServerCredentialsTest, ANewCertificateIsServedWithoutARestart) {
  certificates_->Make("server renewed");
  AccessConfig access;
  access.tls_certificate_file = certificates_->File("renewed.crt");
  access.tls_key_file = certificates_->File("renewed.key");
  Start(access);
  const std::string before = ShakeHands(server_->port(), TLS1_3_VERSION).serial;
  ASSERT_FALSE(before.empty());
  certificates_->Make("server renewed");
  const absl::Time deadline = absl::Now() + absl::Seconds(60);
  std::string now = before;
  while (now == before || now.empty()) {
    ASSERT_LT(absl::Now(), deadline);
    now = ShakeHands(server_->port(), TLS1_3_VERSION).serial;
  }
  EXPECT_TRUE(CreateMission(*certificates_, "").ok());
}

std::string Refusal(const AccessConfig& config) {
  return std::string(MakeServerCredentials(config).status().message());
}

TEST_F(ServerCredentialsTest, FilesThatCannotServeAreRefusedAtOnce) {
  AccessConfig config = Tls(true);
  EXPECT_EQ(Refusal(config), "");
  config.tls_certificate_file = certificates_->File("none.crt");
  EXPECT_THAT(Refusal(config), StartsWith("access.tls_certificate_file = "));
  config = Tls(true);
  config.tls_certificate_file = config.tls_key_file;  // holds no certificate
  EXPECT_THAT(Refusal(config), StartsWith("access.tls_certificate_file = "));
  config = Tls(true);
  config.tls_key_file = certificates_->File("ca.key");
  EXPECT_THAT(Refusal(config), StartsWith("access.tls_key_file = "));
  EXPECT_THAT(Refusal(config), HasSubstr("key values mismatch"));
  config = Tls(true);
  config.client_ca_file = config.tls_key_file;
  EXPECT_THAT(Refusal(config), StartsWith("access.client_ca_file = "));
}

}  // namespace server_credentials_test
}  // namespace plumescout::server
