// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/knock.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>

#include "absl/strings/str_cat.h"
#include "server/server.h"
#include "tests/server/certificates.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace knock_test {

constexpr absl::Duration kPatience = absl::Seconds(60);
constexpr absl::Duration kAMoment = absl::Milliseconds(100);

// Listens, and accepts nobody unless told.
class SilentListener {
 public:
  SilentListener() : descriptor_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(bind(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
    EXPECT_EQ(listen(descriptor_, 1), 0);
    socklen_t size = sizeof(address);
    EXPECT_EQ(getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &size), 0);
    port_ = ntohs(address.sin_port);
  }
  ~SilentListener() { close(descriptor_); }

  int port() const { return port_; }
  void AcceptAndHangUp() { close(accept(descriptor_, nullptr, nullptr)); }

 private:
  int descriptor_;
  int port_ = 0;
};

TEST(KnockTest, WhoAcceptsAndHangsUpHasAnswered) {
  SilentListener listener;
  std::thread accepting([&] { listener.AcceptAndHangUp(); });
  EXPECT_EQ(Knock("127.0.0.1:0", listener.port(), kPatience), absl::OkStatus());
  accepting.join();
}

TEST(KnockTest, AConnectionIsNoAnswer) {
  const SilentListener listener;
  EXPECT_TRUE(absl::IsDeadlineExceeded(Knock("127.0.0.1:0", listener.port(), kAMoment)));
}

TEST(KnockTest, NobodyThereIsUnavailable) {
  int port = 0;
  {
    const SilentListener listener;
    port = listener.port();
  }
  EXPECT_TRUE(absl::IsUnavailable(Knock("127.0.0.1:0", port, kPatience)));
  EXPECT_TRUE(absl::IsUnavailable(Knock("unix:/no/such/socket", 1, kPatience)));
  EXPECT_TRUE(absl::IsUnavailable(Knock("unix:" + std::string(200, 'a'), 1, kPatience)));
}

absl::Status KnockAtServer(const ServerConfig& config) {
  const auto server = Server::Start(config);
  if (!server.ok()) return server.status();
  return Knock(config.listen, (*server)->port(), kPatience);
}

TEST(KnockTest, ServersAnswerWhateverTheySpeak) {
  const TempFolder folder;
  const Certificates certificates;
  certificates.Make("server host");
  ServerConfig config;
  for (const std::string& listen :
       {std::string("127.0.0.1:0"), std::string("0.0.0.0:0"), std::string("localhost:0"),
        absl::StrCat("unix:", folder.File("socket")), std::string("unix-abstract:knock-test")}) {
    config.listen = listen;
    EXPECT_EQ(KnockAtServer(config), absl::OkStatus()) << listen;
  }
  config.listen = "127.0.0.1:0";
  config.access.tls_certificate_file = certificates.File("host.crt");
  config.access.tls_key_file = certificates.File("host.key");
  config.access.client_ca_file = certificates.File("ca.crt");
  config.access.require_client_certificate = true;
  EXPECT_EQ(KnockAtServer(config), absl::OkStatus());
}

}  // namespace knock_test
}  // namespace plumescout::server
