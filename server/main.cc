// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/time/time.h"
#include "core/types/status_macros.h"
#include "server/base/address.h"
#include "server/base/descriptor_limit.h"
#include "server/base/exit_timer.h"
#include "server/base/grpc_log.h"
#include "server/base/heap.h"
#include "server/base/log.h"
#include "server/base/service_manager.h"
#include "server/config/command_line.h"
#include "server/observe/http_endpoints.h"
#include "server/server.h"
#include "server/store_command.h"
#include "server/web/static_files.h"
#include "server/web/web_server.h"

namespace plumescout::server {
namespace {

constexpr int kExitUsage = 2;
constexpr int kExitUnreachable = 3;  // whoever watches over the server starts it again
// How long the end waits for who reads the log.
constexpr absl::Duration kLogPatience = absl::Milliseconds(200);

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
void PrintAddress(const char* what, const std::string& address, int port) {
  if (IsUnixAddress(address)) {
    std::printf("%s on %s\n", what, address.c_str());
  } else {
    std::printf("%s on %s:%d\n", what, address.substr(0, address.rfind(':')).c_str(), port);
  }
  std::fflush(stdout);
}

void LogDescriptorLimit() {
  const auto limit = RaiseDescriptorLimit();
  if (limit.ok()) {
    LogInfo("descriptors",
            {{"limit", absl::StrCat(limit->now)}, {"before", absl::StrCat(limit->before)}});
  } else {
    LogWarning("descriptors not raised", {{"why", std::string(limit.status().message())}});
  }
}

int FailToStart(const absl::Status& status) {
  LogError("cannot start", {{"why", std::string(status.message())}});
  return EXIT_FAILURE;
}

// Null if there is to be no HTTP.
absl::StatusOr<std::unique_ptr<HttpEndpoints>> ServeHttp(const ServerConfig& config,
                                                         const Server& server) {
  const std::string address = HttpListen(config);
  if (address.empty()) return nullptr;
  auto http = HttpEndpoints::Start(
      address, {[&server] { return server.MetricsText(); }, [&server] { return server.NotReady(); },
                [&server] { return server.Trouble(); }});
  if (http.ok()) PrintAddress("metrics", address, (*http)->port());
  return http;
}

// Null if there is to be no console.
absl::StatusOr<std::unique_ptr<WebServer>> ServeConsole(const ServerConfig& config,
                                                        Server& server) {
  const ConsoleConfig& console = config.console;
  if (console.listen.empty()) return nullptr;
  WebOptions options;
  options.max_message_bytes = static_cast<std::size_t>(config.limits.max_receive_bytes);
  options.max_streams = console.max_stream_count;
  options.hosts = absl::StrSplit(console.hosts, ',', absl::SkipEmpty());
  options.takes_subjects =
      config.access.trusted_front == kLocalFront && IsLocalAddress(console.listen);
  std::error_code ignored;  // then pages that are installed are not found
  PLUMESCOUT_ASSIGN_OR_RETURN(
      options.files,
      StaticFiles::LoadOrInstalled(
          console.folder, std::filesystem::read_symlink("/proc/self/exe", ignored).string()));
  auto web = WebServer::Start(console.listen, server.InProcessChannel(), std::move(options));
  if (web.ok()) PrintAddress("console", console.listen, (*web)->port());
  return web;
}

// In one line, for operators.
std::string StateOf(const Server& server) {
  if (std::string why = server.NotReady(); !why.empty()) return why;
  if (std::string trouble = server.Trouble(); !trouble.empty()) return trouble;
  return absl::StrCat("serving on port ", server.port());
}

int Run(const ServerConfig& config) {
  LogDescriptorLimit();
  std::atomic<bool> unreachable = false;
  const auto stop = [] { kill(getpid(), SIGTERM); };  // wakes the wait below
  auto server = Server::Start(config, {}, {.drain = stop, .unreachable = [&unreachable, stop] {
                                             unreachable = true;
                                             stop();
                                           }});
  if (!server.ok()) return FailToStart(server.status());
  auto http = ServeHttp(config, **server);
  if (!http.ok()) return FailToStart(http.status());
  auto web = ServeConsole(config, **server);
  if (!web.ok()) return FailToStart(web.status());
  PrintAddress("listening", config.listen, (*server)->port());
  LogInfo("serving",
          {{"port", absl::StrCat((*server)->port())}, {"boot_id", (*server)->boot_id()}});
  auto manager = std::make_unique<ServiceManager>([&server] { return StateOf(**server); });
  const int signal = WaitForSignal(BlockStopSignals());
  manager.reset();
  LogInfo("draining", {{"signal", absl::StrCat(signal)}});
  const int exit_code = unreachable ? kExitUnreachable : EXIT_SUCCESS;
  const ExitTimer limit(absl::Seconds(config.connection.drain_s) + Server::kStopLimit, exit_code);
  if (*web != nullptr) (*web)->RefuseCalls();
  (*server)->Drain();
  web->reset();
  http->reset();
  server->reset();
  LogInfo("stopped");
  return exit_code;
}

int RunLogged(const ServerConfig& config) {
  BlockStopSignals();  // before the first thread starts
  LimitArenas();
  ReturnLargeBlocks();
  // Who reads our output may go away.
  signal(SIGPIPE, SIG_IGN);
  ConfigureLog(
      {*ParseLogLevel(config.observe.log_level), *ParseLogFormat(config.observe.log_format)});
  TakeGrpcLog();
  const int exit_code = Run(config);
  FlushLog(kLogPatience);
  return exit_code;
}

}  // namespace
}  // namespace plumescout::server

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "store") {
    return plumescout::server::RunStoreCommand(argc - 1, argv + 1, std::cout, std::cerr);
  }
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
  return plumescout::server::RunLogged(command_line->config);
}
