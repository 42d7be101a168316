// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/attacks/front_process.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/strip.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "lab/bench/attacks/raw_connection.h"

namespace plumescout::lab {
namespace {

constexpr char kProgram[] = "/usr/sbin/haproxy";
constexpr std::uint64_t kMaxConfig_bytes = 1 << 20;
constexpr absl::Duration kPatience = absl::Seconds(5);
constexpr absl::Duration kLook = absl::Milliseconds(20);

// A port that nobody listens on now.
absl::StatusOr<int> FreePort() {
  const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return absl::ErrnoToStatus(errno, "socket");
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  const bool known = bind(fd, reinterpret_cast<const sockaddr*>(&address), size) == 0 &&
                     getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  close(fd);
  if (!known) return absl::UnavailableError("no free port");
  return ntohs(address.sin_port);
}

// The configuration with a plain listener at `target` and the server where it is.
std::string Plain(const std::string& config, const std::string& target, const std::string& server) {
  std::string plain;
  for (absl::string_view line : absl::StrSplit(config, '\n')) {
    const absl::string_view words = absl::StripLeadingAsciiWhitespace(line);
    if (absl::StartsWith(words, "bind ")) {
      absl::StrAppend(&plain, "    bind ", target, " proto h2\n");
    } else if (absl::StartsWith(words, "server one ")) {
      absl::StrAppend(&plain, "    server one ", server, " proto h2 maxconn 1000\n");
    } else if (!absl::StrContains(words, "ssl_c_")) {  // without TLS there are no certificates
      absl::StrAppend(&plain, line, "\n");
    }
  }
  return plain;
}

absl::StatusOr<pid_t> Spawn(const std::string& config_path) {
  std::vector<std::string> words = {kProgram, "-db", "-f", config_path};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t pid = 0;
  const int error = posix_spawn(&pid, kProgram, &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return absl::UnavailableError(absl::StrCat("cannot start ", kProgram));
  return pid;
}

}  // namespace

absl::StatusOr<std::unique_ptr<FrontProcess>> FrontProcess::Start(const std::string& config,
                                                                  const std::string& server) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string text, ReadFile(config, kMaxConfig_bytes));
  PLUMESCOUT_ASSIGN_OR_RETURN(const int port, FreePort());
  const std::string target = absl::StrCat("127.0.0.1:", port);
  const std::string path =
      (std::filesystem::temp_directory_path() / absl::StrCat("plumescout-front-", port)).string();
  PLUMESCOUT_RETURN_IF_ERROR(WriteFile(path, Plain(text, target, server)));
  PLUMESCOUT_ASSIGN_OR_RETURN(const pid_t pid, Spawn(path));
  auto front = std::make_unique<FrontProcess>(Private(), pid, target, path);
  for (const absl::Time end = absl::Now() + kPatience; absl::Now() < end;) {
    if (RawConnection::Open(target).ok()) return front;
    absl::SleepFor(kLook);
  }
  return absl::UnavailableError("the front does not listen");
}

FrontProcess::~FrontProcess() {
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
  unlink(config_path_.c_str());
}

}  // namespace plumescout::lab
