// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/observe/http_endpoints.h"

#include <errno.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/string_view.h"
#include "core/types/status_macros.h"
#include "server/base/tcp_listener.h"

namespace plumescout::server {
namespace {

constexpr std::size_t kMaxConnections = 16;
constexpr std::size_t kMaxRequestBytes = 4096;
constexpr absl::Duration kTimeForARequest = absl::Seconds(2);
// How long to wait after a connection could not be taken, for want of descriptors perhaps.
constexpr absl::Duration kAcceptPause = absl::Milliseconds(100);
constexpr char kText[] = "text/plain; charset=utf-8";
constexpr char kMetricsText[] = "text/plain; version=0.0.4; charset=utf-8";
constexpr char kHeadEnd[] = "\r\n\r\n";

std::string Response(absl::string_view status, absl::string_view type, absl::string_view body) {
  return absl::StrCat("HTTP/1.1 ", status, "\r\nContent-Type: ", type,
                      "\r\nContent-Length: ", body.size(),
                      "\r\nCache-Control: no-store\r\nConnection: close", kHeadEnd, body);
}

}  // namespace

HttpEndpoints::HttpEndpoints(Private, int listener, HttpSources sources)
    : listener_(listener),
      stop_event_(eventfd(0, EFD_CLOEXEC)),
      sources_(std::move(sources)),
      thread_([this] { Run(); }) {}

HttpEndpoints::~HttpEndpoints() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t told = write(stop_event_, &one, sizeof(one));
  thread_.join();
  for (const Connection& connection : connections_) close(connection.fd);
  close(stop_event_);
  close(listener_);
}

absl::StatusOr<std::unique_ptr<HttpEndpoints>> HttpEndpoints::Start(const std::string& address,
                                                                    HttpSources sources) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const int listener, ListenOnTcp(address));
  return std::make_unique<HttpEndpoints>(Private(), listener, std::move(sources));
}

int HttpEndpoints::port() const { return ListenerPort(listener_); }

void HttpEndpoints::Run() {
  while (Await()) {
    if (connections_.size() < kMaxConnections && SteadyNow() >= accept_after_) Accept();
    for (auto it = connections_.begin(); it != connections_.end();) {
      if (Advance(*it)) {
        ++it;
        continue;
      }
      close(it->fd);
      it = connections_.erase(it);
    }
  }
}

bool HttpEndpoints::Await() {
  const SteadyTime now = SteadyNow();
  std::vector<pollfd> wanted = {{stop_event_, POLLIN, 0}};
  SteadyTime until = SteadyTime::max();
  if (now < accept_after_) {
    until = accept_after_;
  } else if (connections_.size() < kMaxConnections) {
    wanted.push_back({listener_, POLLIN, 0});
  }
  for (const Connection& connection : connections_) {
    const short event = connection.answer.empty() ? POLLIN : POLLOUT;
    wanted.push_back({connection.fd, event, 0});
    until = std::min(until, connection.deadline);
  }
  constexpr int kForEver = -1;
  constexpr std::int64_t kRoundUp_ms = 1;
  const int patience_ms =
      until == SteadyTime::max()
          ? kForEver
          : static_cast<int>(absl::ToInt64Milliseconds(absl::FromChrono(
                                 std::max(until - now, SteadyTime::duration::zero()))) +
                             kRoundUp_ms);
  poll(wanted.data(), wanted.size(), patience_ms);
  return (wanted.front().revents & POLLIN) == 0;
}

void HttpEndpoints::Accept() {
  const int fd = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (fd >= 0) {
    connections_.push_back({fd, After(SteadyNow(), kTimeForARequest)});
  } else if (errno != EAGAIN && errno != EINTR && errno != ECONNABORTED) {
    accept_after_ = After(SteadyNow(), kAcceptPause);
  }
}

bool HttpEndpoints::Advance(Connection& connection) const {
  if (SteadyNow() >= connection.deadline) return false;
  if (connection.answer.empty() && !Receive(connection)) return false;
  while (connection.sent < connection.answer.size()) {
    const ssize_t count = send(connection.fd, connection.answer.data() + connection.sent,
                               connection.answer.size() - connection.sent, MSG_NOSIGNAL);
    if (count < 0) return errno == EAGAIN || errno == EINTR;
    connection.sent += static_cast<std::size_t>(count);
  }
  return connection.answer.empty();
}

bool HttpEndpoints::Receive(Connection& connection) const {
  std::array<char, kMaxRequestBytes> part;
  const ssize_t count = recv(connection.fd, part.data(), part.size(), 0);
  if (count <= 0) return count < 0 && (errno == EAGAIN || errno == EINTR);
  connection.received.append(part.data(), static_cast<std::size_t>(count));
  if (connection.received.size() > kMaxRequestBytes) {
    connection.answer = Response("431 Request Header Fields Too Large", kText, "too large\n");
  } else if (connection.received.find(kHeadEnd) != std::string::npos) {
    connection.answer = Answer(connection.received);
  }
  return true;
}

std::string HttpEndpoints::Answer(const std::string& request) const {
  const std::vector<absl::string_view> words =
      absl::StrSplit(absl::string_view(request).substr(0, request.find('\r')), ' ');
  if (words.size() != 3) return Response("400 Bad Request", kText, "no request\n");
  if (words[0] != "GET") return Response("405 Method Not Allowed", kText, "GET only\n");
  const absl::string_view path = words[1].substr(0, words[1].find('?'));
  if (path == "/metrics") return Response("200 OK", kMetricsText, sources_.metrics());
  if (path == "/healthz") return Response("200 OK", kText, "ok\n");
  if (path != "/readyz") return Response("404 Not Found", kText, "/metrics, /healthz, /readyz\n");
  const std::string why = sources_.not_ready();
  if (!why.empty()) return Response("503 Service Unavailable", kText, absl::StrCat(why, "\n"));
  const std::string trouble = sources_.trouble();
  return Response("200 OK", kText, absl::StrCat("ok\n", trouble, trouble.empty() ? "" : "\n"));
}

}  // namespace plumescout::server
