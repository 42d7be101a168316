// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/web/web_server.h"

#include <errno.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "core/types/status_macros.h"
#include "server/base/address.h"
#include "server/base/errors.h"
#include "server/base/grpc_status.h"
#include "server/base/tcp_listener.h"
#include "server/web/grpc_web.h"

namespace plumescout::server {
namespace {

constexpr std::size_t kReadBytes = 65'536;
// Of requests and messages of one connection before the others have their turn.
constexpr int kMaxStepsOfTurn = 32;
// How long to wait after a connection could not be taken, for want of descriptors perhaps.
constexpr absl::Duration kAcceptPause = absl::Milliseconds(100);
// Of a request that was refused.
constexpr std::size_t kMaxDroppedBytes = std::size_t{64} << 20;
constexpr char kNoStore[] = "no-store";
constexpr absl::string_view kSubject = "x-plumescout-subject";
// What a browser's call brings along that calls may have.
constexpr std::array<absl::string_view, 3> kMetadata = {"authorization", "x-request-id", kSubject};

std::string RefusedCall(const grpc::Status& status) {
  return HttpAnswerOf(200, kGrpcWebType, kNoStore, TrailerFrame(status));
}

// All of an answer but its body.
std::string HeadOf(const std::string& answer) {
  constexpr char kHeadEnd[] = "\r\n\r\n";
  return answer.substr(0, answer.find(kHeadEnd) + sizeof(kHeadEnd) - 1);
}

std::int64_t ToPollTimeout(SteadyTime until) {
  constexpr int kForEver = -1;
  constexpr std::int64_t kRoundUp_ms = 1;
  if (until == SteadyTime::max()) return kForEver;
  const auto left = std::max(until - SteadyNow(), SteadyTime::duration::zero());
  return absl::ToInt64Milliseconds(absl::FromChrono(left)) + kRoundUp_ms;
}

// Ends connections, and with them streams, of hosts that vanished without a word, in about a
// minute; and lets small messages go at once.
void WatchPeer(int fd) {
  struct Option {
    int level;
    int name;
    int value;
  };
  constexpr std::array<Option, 6> kOptions = {{{SOL_SOCKET, SO_KEEPALIVE, 1},
                                               {IPPROTO_TCP, TCP_KEEPIDLE, 30},   // s
                                               {IPPROTO_TCP, TCP_KEEPINTVL, 10},  // s
                                               {IPPROTO_TCP, TCP_KEEPCNT, 3},
                                               {IPPROTO_TCP, TCP_USER_TIMEOUT, 60'000},  // ms
                                               {IPPROTO_TCP, TCP_NODELAY, 1}}};
  for (const Option& option : kOptions) {
    setsockopt(fd, option.level, option.name, &option.value, sizeof(option.value));
  }
}

}  // namespace

// Outlives the server for as long as calls may ring it.
class WebServer::Bell {
 public:
  Bell() : fd_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}
  ~Bell() { close(fd_); }
  Bell(const Bell&) = delete;
  Bell& operator=(const Bell&) = delete;

  int fd() const { return fd_; }
  void Ring() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const ssize_t told = write(fd_, &one, sizeof(one));
  }
  void Silence() const {
    std::uint64_t rings = 0;
    [[maybe_unused]] const ssize_t heard = read(fd_, &rings, sizeof(rings));
  }
  std::atomic<bool> stop = false;

 private:
  const int fd_;
};

WebServer::WebServer(Private, int listener, bool local, std::shared_ptr<grpc::Channel> channel,
                     WebOptions options)
    : listener_(listener),
      local_(local),
      channel_(std::move(channel)),
      options_(std::move(options)),
      bell_(std::make_shared<Bell>()),
      thread_([this] { Run(); }) {}

WebServer::~WebServer() {
  bell_->stop = true;
  bell_->Ring();
  thread_.join();
  for (const Connection& connection : connections_) {
    if (connection.call != nullptr) connection.call->Cancel();
    close(connection.fd);
  }
  close(listener_);
}

absl::StatusOr<std::unique_ptr<WebServer>> WebServer::Start(const std::string& address,
                                                            std::shared_ptr<grpc::Channel> channel,
                                                            WebOptions options) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const int listener, ListenOnTcp(address));
  return std::make_unique<WebServer>(Private(), listener, IsLocalAddress(address),
                                     std::move(channel), std::move(options));
}

int WebServer::port() const { return ListenerPort(listener_); }

void WebServer::Run() {
  while (Await()) {
    if (SteadyNow() >= accept_after_) Accept();
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

bool WebServer::Await() {
  std::vector<pollfd> wanted = {{bell_->fd(), POLLIN, 0}};
  SteadyTime until = SteadyTime::max();
  bool has_more = false;
  if (SteadyNow() < accept_after_) {
    until = accept_after_;
  } else {
    wanted.push_back({listener_, POLLIN, 0});
  }
  for (const Connection& connection : connections_) {
    // While an answer is on its way nothing is read; calls end when the other side hangs up.
    int in = connection.call != nullptr ? POLLRDHUP : 0;
    if (connection.call == nullptr && connection.out.empty()) in = POLLIN;
    const int out = connection.out.empty() ? 0 : POLLOUT;
    wanted.push_back({connection.fd, static_cast<short>(in | out), 0});
    until = std::min(until, connection.deadline);
    has_more = has_more || connection.has_more;
  }
  poll(wanted.data(), wanted.size(), has_more ? 0 : static_cast<int>(ToPollTimeout(until)));
  bell_->Silence();
  return !bell_->stop;
}

void WebServer::Accept() {
  const int fd = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (fd < 0) {
    if (errno != EAGAIN && errno != EINTR && errno != ECONNABORTED) {
      accept_after_ = After(SteadyNow(), kAcceptPause);
    }
    return;
  }
  const int limit = options_.max_streams + options_.max_calls + options_.max_spare_connections;
  if (connections_.size() >= static_cast<std::size_t>(limit)) {
    // Browsers keep connections open that they have no use for.
    const auto idle = std::find_if(connections_.begin(), connections_.end(),
                                   [](const Connection& other) { return other.is_idle(); });
    if (idle == connections_.end()) {
      close(fd);
      return;
    }
    close(idle->fd);
    connections_.erase(idle);
  }
  WatchPeer(fd);
  connections_.push_back({fd, After(SteadyNow(), options_.request_patience)});
}

bool WebServer::Advance(Connection& connection) {
  if (SteadyNow() >= connection.deadline) return false;
  pollfd hung_up{connection.fd, POLLRDHUP, 0};
  if (connection.call != nullptr && poll(&hung_up, 1, 0) > 0) return false;
  connection.has_more = false;
  for (int step = 0; step < kMaxStepsOfTurn; ++step) {
    if (!Send(connection)) return false;
    if (!connection.out.empty()) return true;
    if (connection.call != nullptr) {
      TakeFrames(connection);
      if (connection.out.empty()) return true;
      continue;
    }
    if (connection.said_all) return Drop(connection);
    if (connection.close_after) {
      EndAnswers(connection);
      continue;
    }
    // More is received only once all that came is answered: what waits here is bounded.
    Answer(connection);
    if (!connection.out.empty()) continue;
    if (!Receive(connection)) return false;
    Answer(connection);
    if (connection.out.empty()) return true;
  }
  connection.has_more = true;
  return true;
}

bool WebServer::Receive(Connection& connection) const {
  std::array<char, kReadBytes> part;
  const bool was_idle = connection.is_idle();
  const ssize_t count = recv(connection.fd, part.data(), part.size(), 0);
  if (count <= 0) return count < 0 && (errno == EAGAIN || errno == EINTR);
  connection.received.append(part.data(), static_cast<std::size_t>(count));
  if (was_idle) connection.deadline = After(SteadyNow(), options_.request_patience);
  return true;
}

// Closed at once while more comes, TCP would throw away the answer that is on its way.
void WebServer::EndAnswers(Connection& connection) const {
  shutdown(connection.fd, SHUT_WR);
  connection.received.clear();
  connection.said_all = true;
  connection.deadline = After(SteadyNow(), options_.request_patience);
}

bool WebServer::Drop(Connection& connection) const {
  std::array<char, kReadBytes> part;
  const ssize_t count = recv(connection.fd, part.data(), part.size(), 0);
  if (count <= 0) return count < 0 && (errno == EAGAIN || errno == EINTR);
  connection.dropped_bytes += static_cast<std::size_t>(count);
  return connection.dropped_bytes <= kMaxDroppedBytes;
}

bool WebServer::Send(Connection& connection) const {
  while (connection.sent < connection.out.size()) {
    const ssize_t count = send(connection.fd, connection.out.data() + connection.sent,
                               connection.out.size() - connection.sent, MSG_NOSIGNAL);
    if (count < 0) return errno == EAGAIN || errno == EINTR;
    connection.sent += static_cast<std::size_t>(count);
    connection.deadline =
        std::min(After(SteadyNow(), options_.reader_patience), connection.answer_deadline);
  }
  if (connection.out.empty()) return true;
  connection.out.clear();
  connection.sent = 0;
  connection.answer_deadline = SteadyTime::max();
  connection.deadline =
      connection.call != nullptr
          ? SteadyTime::max()  // calls have deadlines of their own, or none
          : After(SteadyNow(),
                  connection.received.empty() ? options_.idle_patience : options_.request_patience);
  return true;
}

void WebServer::TakeFrames(Connection& connection) {
  const std::string frames = connection.call->Take();
  if (!frames.empty()) connection.out = HttpChunk(frames);
  if (connection.call->ended()) {
    connection.out += kLastChunk;
    connection.call = nullptr;
  }
  if (!connection.out.empty()) {
    connection.deadline = After(SteadyNow(), options_.reader_patience);
  }
}

void WebServer::Answer(Connection& connection) {
  const HttpParse parse =
      ParseHttp(connection.received, options_.max_message_bytes + kGrpcWebPrefixBytes);
  if (parse.state == HttpParse::State::kPartial) return;
  connection.deadline = After(SteadyNow(), options_.reader_patience);
  if (parse.state == HttpParse::State::kBad) {
    connection.out = HttpRefusal(parse.code, parse.why);
    connection.close_after = true;  // who knows where the next request begins
    return;
  }
  connection.received.erase(0, parse.size);
  const HttpRequest& request = parse.request;
  connection.close_after = absl::EqualsIgnoreCase(request.Header("connection"), "close");
  const std::string suspicion = Suspicion(request);
  if (!suspicion.empty()) {
    connection.out = HttpRefusal(403, suspicion);
  } else if (request.method == "POST") {
    StartCall(request, connection);
  } else if (request.method == "GET" || request.method == "HEAD") {
    connection.out = AnswerFile(request);
  } else {
    connection.out = HttpRefusal(405, "GET, HEAD and POST only");
  }
  if (request.method == "HEAD") connection.out = HeadOf(connection.out);
  if (connection.call == nullptr) {
    connection.answer_deadline = After(SteadyNow(), options_.answer_patience);
  }
}

bool WebServer::IsNameOfFront(absl::string_view host) const {
  return std::find(options_.hosts.begin(), options_.hosts.end(), host) != options_.hosts.end();
}

std::string WebServer::Suspicion(const HttpRequest& request) const {
  const absl::string_view host = request.Header("host");
  if (host.empty()) return "no Host";
  const bool any_name = !local_ && options_.hosts.empty();
  const bool of_loopback = !IsUnixAddress(host) && IsLocalAddress(host);
  if (!any_name && !of_loopback && !IsNameOfFront(host)) {
    return local_ ? "the console is served to this machine alone"
                  : "the console has other names: console.hosts";
  }
  absl::string_view origin = request.Header("origin");
  if (origin.empty()) return "";
  if ((absl::ConsumePrefix(&origin, "https://") || absl::ConsumePrefix(&origin, "http://")) &&
      (origin == host || IsNameOfFront(origin))) {
    return "";
  }
  return "pages of other hosts may not call";
}

std::string WebServer::AnswerFile(const HttpRequest& request) const {
  const StaticFile* const file = options_.files.Find(request.path);
  if (file == nullptr) {
    return HttpRefusal(404, options_.files.empty() && request.path == "/"
                                ? "no console here: start the server with --http-root FOLDER"
                                : "no such file");
  }
  return HttpAnswerOf(200, file->type, file->caching, file->content);
}

int WebServer::CountCalls(bool streams) const {
  return static_cast<int>(std::count_if(
      connections_.begin(), connections_.end(), [streams](const Connection& connection) {
        return connection.call != nullptr && connection.is_stream == streams;
      }));
}

void WebServer::RefuseCalls() {
  const absl::MutexLock lock(&begin_mutex_);
  refuses_calls_ = true;
}

void WebServer::StartCall(const HttpRequest& request, Connection& connection) {
  if (!absl::StartsWith(request.Header("content-type"), "application/grpc-web") ||
      absl::StartsWith(request.Header("content-type"), "application/grpc-web-text")) {
    connection.out = HttpRefusal(415, absl::StrCat("calls are of type ", kGrpcWebType));
    return;
  }
  const auto refuse = [&connection](grpc::StatusCode code, const std::string& why) {
    connection.out = RefusedCall(grpc::Status(code, why));
  };
  const std::optional<WebMethod> method = FindWebMethod(request.path);
  if (!method) return refuse(grpc::StatusCode::UNIMPLEMENTED, "browsers cannot call this");
  std::optional<std::string> message = MessageOfBody(request.body);
  if (!message) {
    return refuse(grpc::StatusCode::INVALID_ARGUMENT, "the body is not one message of gRPC-Web");
  }
  const int limit = method->is_stream ? options_.max_streams : options_.max_calls;
  if (CountCalls(method->is_stream) >= limit) {
    return refuse(grpc::StatusCode::RESOURCE_EXHAUSTED,
                  absl::StrCat("too many ", method->is_stream ? "streams" : "calls",
                               " of browsers at one time: ", limit));
  }
  WebCall::Parts parts;
  parts.method = method->path;
  parts.message = *std::move(message);
  for (const absl::string_view name : kMetadata) {
    if (name == kSubject && !options_.takes_subjects) continue;
    const absl::string_view value = request.Header(std::string(name));
    if (value.empty()) continue;
    if (!std::all_of(value.begin(), value.end(), absl::ascii_isprint)) {
      return refuse(grpc::StatusCode::INVALID_ARGUMENT, absl::StrCat(name, " is not ASCII"));
    }
    parts.metadata.emplace(name, value);
  }
  parts.timeout = ParseGrpcTimeout(request.Header("grpc-timeout"));
  if (!method->is_stream) {
    parts.timeout =
        std::min(parts.timeout.value_or(options_.call_patience), options_.call_patience);
  }
  parts.wake = [bell = bell_] { bell->Ring(); };
  const absl::MutexLock lock(&begin_mutex_);
  if (refuses_calls_) {
    connection.out = RefusedCall(ToGrpc(Draining()));
    return;
  }
  connection.is_stream = method->is_stream;
  connection.call = WebCall::Start(channel_, std::move(parts));
  connection.out = HttpHead(200, kGrpcWebType, kNoStore, kChunked);
}

}  // namespace plumescout::server
