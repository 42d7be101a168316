// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/channel.h>

#include <cstddef>
#include <list>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/time.h"
#include "server/base/clock.h"
#include "server/web/http_message.h"
#include "server/web/static_files.h"
#include "server/web/web_call.h"

namespace plumescout::server {

struct WebOptions {
  StaticFiles files = {};
  std::vector<std::string> hosts = {};  // names of a front, as they stand in addresses
  // Whoever connects is the trusted front, and says by x-plumescout-subject who calls. Else that is
  // not passed on.
  bool takes_subjects = false;
  std::size_t max_message_bytes = 262'144;  // of a request
  int max_streams = 64;                     // at one time, of all pages
  int max_calls = 64;                       // that are no streams, at one time
  // Beside those of streams and calls: for files, and those that browsers keep without a use.
  int max_spare_connections = 128;
  absl::Duration request_patience =
      absl::Seconds(10);                             // from the first byte of a request to its last
  absl::Duration idle_patience = absl::Seconds(60);  // between requests of a connection
  // Whoever takes no byte of an answer for so long is hung up on.
  absl::Duration reader_patience = absl::Seconds(20);
  // From the first byte of an answer that is no call's to its last.
  absl::Duration answer_patience = absl::Seconds(60);
  absl::Duration call_patience = absl::Seconds(60);  // of calls that are no streams
};

// What browsers see: the files of a console, and the methods of plumescout.v1 in gRPC-Web, which
// pass the same door as all calls. One thread moves bytes between sockets and calls and waits for
// nobody: a page that does not read costs its connection and one message. Only pages that this
// server gave out may call (the header Origin), and where it listens on loopback, only by names of
// loopback or of the front (the header Host): pages of other hosts cannot act for whoever looks at
// them.
class WebServer {
  struct Private {
    explicit Private() = default;
  };

 public:
  WebServer(Private, int listener, bool local, std::shared_ptr<grpc::Channel> channel,
            WebOptions options);  // Start makes them
  // `address`: HOST:PORT with a numeric host; port 0: any free one. kUnavailable if it cannot be
  // listened on.
  static absl::StatusOr<std::unique_ptr<WebServer>> Start(const std::string& address,
                                                          std::shared_ptr<grpc::Channel> channel,
                                                          WebOptions options);
  // Cancels the calls that last still.
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  int port() const;
  // From now on calls are refused, as a server that drains does. Before the server behind the
  // channel is shut down: gRPC does not bear calls that begin on a channel in the process after
  // that.
  void RefuseCalls();

 private:
  class Bell;  // wakes the thread

  struct Connection {
    int fd = -1;
    SteadyTime deadline;  // of what it is at
    std::string received = {};
    std::string out = {};
    std::size_t sent = 0;
    SteadyTime answer_deadline = SteadyTime::max();  // of `out`, however it goes on
    std::unique_ptr<WebCall> call = nullptr;         // whose answer is on its way
    bool is_stream = false;
    bool close_after = false;  // once `out` is sent
    bool has_more = false;     // to do at once: others came first
    bool said_all = false;     // what comes is dropped until the other side closes
    std::size_t dropped_bytes = 0;

    bool is_idle() const { return call == nullptr && out.empty() && received.empty(); }
  };

  void Run();
  // Waits for something to do. False if it is time to stop.
  bool Await();
  void Accept();
  // Takes the exchange as far as it goes now. False once it is over.
  bool Advance(Connection& connection);
  // Each false if the connection is at its end.
  bool Receive(Connection& connection) const;
  bool Send(Connection& connection) const;
  bool Drop(Connection& connection) const;
  // After the last answer.
  void EndAnswers(Connection& connection) const;
  // Puts what the call has to say behind what is sent; hands the connection back after the last of
  // it.
  void TakeFrames(Connection& connection);
  // Of the request at the front of what was received, if it is whole.
  void Answer(Connection& connection);
  std::string AnswerFile(const HttpRequest& request) const;
  bool IsNameOfFront(absl::string_view host) const;
  // Why the page may not ask this; empty: it may.
  std::string Suspicion(const HttpRequest& request) const;
  void StartCall(const HttpRequest& request, Connection& connection);
  int CountCalls(bool streams) const;

  const int listener_;
  const bool local_;
  const std::shared_ptr<grpc::Channel> channel_;
  const WebOptions options_;
  const std::shared_ptr<Bell> bell_;
  absl::Mutex begin_mutex_;  // held while a call begins
  bool refuses_calls_ ABSL_GUARDED_BY(begin_mutex_) = false;
  // Of the thread.
  std::list<Connection> connections_;
  SteadyTime accept_after_;

  std::thread thread_;  // last: it uses all of the above
};

}  // namespace plumescout::server
