// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <thread>

#include "absl/status/statusor.h"
#include "server/base/clock.h"

namespace plumescout::server {

// What HTTP tells. Called on its thread, until the endpoints are gone.
struct HttpSources {
  std::function<std::string()> metrics;  // in Prometheus' text format
  // Why calls are not served, or will not be for long; empty: they are.
  std::function<std::string()> not_ready;
  // What is amiss though they are; empty: nothing.
  std::function<std::string()> trouble = [] { return std::string(); };
};

// GET /metrics; GET /healthz, 200 as long as the process lives; GET /readyz, 200 or 503. One thread
// serves few connections at a time, one small request on each, and gives each little time: who is
// slow or silent holds up nobody.
class HttpEndpoints {
  struct Private {
    explicit Private() = default;
  };

 public:
  HttpEndpoints(Private, int listener, HttpSources sources);  // Start makes them
  // `address`: HOST:PORT with a numeric host; port 0: any free one. kUnavailable if it cannot be
  // listened on.
  static absl::StatusOr<std::unique_ptr<HttpEndpoints>> Start(const std::string& address,
                                                              HttpSources sources);
  ~HttpEndpoints();
  HttpEndpoints(const HttpEndpoints&) = delete;
  HttpEndpoints& operator=(const HttpEndpoints&) = delete;

  int port() const;

 private:
  struct Connection {
    int fd = -1;
    SteadyTime deadline;
    std::string received = {};
    std::string answer = {};  // empty until the request is whole
    std::size_t sent = 0;
  };

  void Run();
  // Waits for something to do. False if it is time to stop.
  bool Await();
  void Accept();
  // Takes the exchange as far as it goes now. False once it is over.
  bool Advance(Connection& connection) const;
  bool Receive(Connection& connection) const;
  std::string Answer(const std::string& request) const;

  const int listener_;
  const int stop_event_;
  const HttpSources sources_;
  // Of the thread.
  std::list<Connection> connections_;
  SteadyTime accept_after_;

  std::thread thread_;  // last: it uses all of the above
};

}  // namespace plumescout::server
