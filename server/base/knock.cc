// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/knock.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <memory>

#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "absl/time/clock.h"
#include "server/base/address.h"

namespace plumescout::server {
namespace {

class Socket {
 public:
  explicit Socket(int family)
      : descriptor_(socket(family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {}
  ~Socket() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  int descriptor() const { return descriptor_; }
  // Whether one of the events came before the deadline.
  bool Await(short events, absl::Time deadline) const {
    pollfd wanted{descriptor_, events, 0};
    const absl::Duration left = std::max(absl::ZeroDuration(), deadline - absl::Now());
    return poll(&wanted, 1, static_cast<int>(absl::ToInt64Milliseconds(left))) > 0;
  }

 private:
  const int descriptor_;
};

absl::Status NoConnection(int error) {
  return absl::UnavailableError(absl::StrCat("no connection: ", std::strerror(error)));
}

absl::Status KnockAt(const sockaddr* address, socklen_t length, absl::Time deadline) {
  const Socket socket(address->sa_family);
  if (socket.descriptor() < 0) return NoConnection(errno);
  if (connect(socket.descriptor(), address, length) != 0 && errno != EINPROGRESS) {
    return NoConnection(errno);
  }
  if (!socket.Await(POLLOUT, deadline)) return absl::DeadlineExceededError("no connection in time");
  int error = 0;
  socklen_t size = sizeof(error);
  getsockopt(socket.descriptor(), SOL_SOCKET, SO_ERROR, &error, &size);
  if (error != 0) return NoConnection(error);
  shutdown(socket.descriptor(), SHUT_WR);
  // Bytes, the end and a reset are all answers.
  if (socket.Await(POLLIN, deadline)) return absl::OkStatus();
  return absl::DeadlineExceededError("connected, but not answered");
}

absl::Status KnockAtUnix(absl::string_view path, bool abstract, absl::Time deadline) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::size_t offset = abstract ? 1 : 0;  // the name of an abstract socket follows a zero
  if (path.size() + offset + 1 > sizeof(address.sun_path)) return NoConnection(ENAMETOOLONG);
  std::copy(path.begin(), path.end(), address.sun_path + offset);
  const std::size_t length = offsetof(sockaddr_un, sun_path) + offset + path.size();
  return KnockAt(reinterpret_cast<const sockaddr*>(&address),
                 static_cast<socklen_t>(abstract ? length : sizeof(address)), deadline);
}

}  // namespace

absl::Status Knock(const std::string& listen, int port, absl::Duration timeout) {
  const absl::Time deadline = absl::Now() + timeout;
  absl::string_view path = listen;
  if (absl::ConsumePrefix(&path, "unix-abstract:")) return KnockAtUnix(path, true, deadline);
  if (absl::ConsumePrefix(&path, "unix:")) {
    absl::ConsumePrefix(&path, "//");
    return KnockAtUnix(path, false, deadline);
  }
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const std::string host = SplitHostPort(listen).host;
  const int error = getaddrinfo(host.c_str(), absl::StrCat(port).c_str(), &hints, &found);
  if (error != 0) {
    return absl::UnavailableError(absl::StrCat("no address of ", host, ": ", gai_strerror(error)));
  }
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses(found, freeaddrinfo);
  absl::Status status = absl::UnavailableError("no address");
  for (const addrinfo* at = found; at != nullptr && !status.ok(); at = at->ai_next) {
    status = KnockAt(at->ai_addr, at->ai_addrlen, deadline);
  }
  return status;
}

}  // namespace plumescout::server
