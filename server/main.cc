// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <signal.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "absl/strings/str_cat.h"
#include "server/base/log.h"
#include "server/config/command_line.h"
#include "server/server.h"

namespace plumescout::server {
namespace {

constexpr int kExitUsage = 2;

// Signals that stop the server are taken by WaitForSignal, whichever thread they would meet.
sigset_t BlockStopSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

int WaitForSignal(const sigset_t& signals) {
  int signal = 0;
  sigwait(&signals, &signal);
  return signal;
}

// Programs that start a server on port 0 read the port from this line.
void PrintAddress(const ServerConfig& config, int port) {
  const std::string host = config.listen.substr(0, config.listen.rfind(':'));
  std::printf("listening on %s:%d\n", host.c_str(), port);
  std::fflush(stdout);
}

int Run(const ServerConfig& config) {
  const sigset_t signals = BlockStopSignals();  // before the first thread starts
  auto server = Server::Start(config);
  if (!server.ok()) {
    LogWarning("cannot start", {{"why", std::string(server.status().message())}});
    return EXIT_FAILURE;
  }
  PrintAddress(config, (*server)->port());
  LogInfo("serving",
          {{"port", absl::StrCat((*server)->port())}, {"boot_id", (*server)->boot_id()}});
  const int signal = WaitForSignal(signals);
  LogInfo("draining", {{"signal", absl::StrCat(signal)}});
  (*server)->Drain();
  LogInfo("stopped");
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace plumescout::server

int main(int argc, char** argv) {
  const auto command_line = plumescout::server::ReadCommandLine(argc, argv);
  if (!command_line.ok()) {
    std::fprintf(stderr, "plumescout-server: %s\n",
                 std::string(command_line.status().message()).c_str());
    return plumescout::server::kExitUsage;
  }
  if (command_line->print.has_value()) {
    std::printf("%s", command_line->print->c_str());
    return EXIT_SUCCESS;
  }
  return plumescout::server::Run(command_line->config);
}
