// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/service_manager.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <string>

#include "absl/strings/str_cat.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace service_manager_test {

// What systemd is to a service: a socket for datagrams that NOTIFY_SOCKET names.
class Manager {
 public:
  Manager() : path_(folder_.File("notify")), socket_(socket(AF_UNIX, SOCK_DGRAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path_.c_str(), sizeof(address.sun_path) - 1);
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    setenv("NOTIFY_SOCKET", path_.c_str(), 1);
  }
  ~Manager() {
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
    unsetenv("WATCHDOG_PID");
    close(socket_);
  }
  void AskForSignsOfLife(int period_us) {
    setenv("WATCHDOG_USEC", absl::StrCat(period_us).c_str(), 1);
    setenv("WATCHDOG_PID", absl::StrCat(getpid()).c_str(), 1);
  }
  // Waits for it.
  std::string Next() {
    std::array<char, 512> words{};
    const ssize_t size = recv(socket_, words.data(), words.size(), 0);
    return {words.data(), static_cast<std::size_t>(size < 0 ? 0 : size)};
  }
  bool HasMore() {
    char one = 0;
    return recv(socket_, &one, 1, MSG_DONTWAIT | MSG_PEEK) >= 0;
  }

 private:
  const TempFolder folder_;
  const std::string path_;
  const int socket_;
};

TEST(ServiceManagerTest, IsToldThatTheServerServesAndStops) {
  Manager manager;
  {
    const ServiceManager told([] { return "serves two missions"; });
    EXPECT_EQ(manager.Next(), "READY=1\nSTATUS=serves two missions");
    EXPECT_FALSE(manager.HasMore()) << "nobody asked for signs of life";
  }
  EXPECT_EQ(manager.Next(), "STOPPING=1\nSTATUS=stopping");
}

TEST(ServiceManagerTest, GetsSignsOfLifeThatSayHowTheServerIs) {
  Manager manager;
  manager.AskForSignsOfLife(2000);
  int asked = 0;
  const ServiceManager told([&] { return absl::StrCat("asked ", ++asked, " times"); });
  EXPECT_EQ(manager.Next(), "READY=1\nSTATUS=asked 1 times");
  EXPECT_EQ(manager.Next(), "WATCHDOG=1\nSTATUS=asked 2 times");
  EXPECT_EQ(manager.Next(), "WATCHDOG=1\nSTATUS=asked 3 times");
}

TEST(ServiceManagerTest, WithoutOneNothingHappens) {
  unsetenv("NOTIFY_SOCKET");
  const ServiceManager told([] { return "alone"; });
}

}  // namespace service_manager_test
}  // namespace plumescout::server
