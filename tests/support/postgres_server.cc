// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/postgres_server.h"

#include <fcntl.h>
#include <pwd.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"

namespace plumescout {
namespace {

constexpr int kStartTries = 600;

[[noreturn]] void Fail(const std::string& what) {
  std::fprintf(stderr, "%s (scripts/setup --ci installs what tests need)\n", what.c_str());
  std::abort();
}

// Debian keeps each version in a folder of its own.
std::string Program(const std::string& name) {
  std::error_code ignored;
  for (const auto& version : std::filesystem::directory_iterator("/usr/lib/postgresql", ignored)) {
    const std::string path = version.path().string() + "/bin/" + name;
    if (access(path.c_str(), X_OK) == 0) return path;
  }
  Fail("no " + name + " of PostgreSQL");
}

// PostgreSQL refuses to run as root; then it runs as nobody.
std::vector<std::string> AsUser() {
  std::vector<std::string> command = {"setpriv", "--pdeathsig", "INT"};
  if (geteuid() != 0) return command;
  command.insert(command.end(), {"--reuid", "nobody", "--regid", "nogroup", "--clear-groups"});
  return command;
}

pid_t Spawn(const std::vector<std::string>& command, const std::string& log) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t process = 0;
  // The program's own environment holds what is preloaded into tests.
  std::string path = "PATH=/usr/bin:/bin";
  std::string locale = "LC_ALL=C";
  std::array<char*, 3> environment = {path.data(), locale.data(), nullptr};
  const int error =
      posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) Fail("cannot start " + command[0]);
  return process;
}

void RunToEnd(const std::vector<std::string>& command, const std::string& log) {
  int status = 0;
  waitpid(Spawn(command, log), &status, 0);
  if (status != 0) Fail(absl::StrCat(command.back(), " failed, see ", log));
}

std::string Output(const std::string& command, bool& ok) {
  FILE* const pipe = popen(command.c_str(), "re");
  if (pipe == nullptr) Fail("cannot start psql");
  std::string output;
  std::array<char, 4096> piece{};
  while (const std::size_t size = fread(piece.data(), 1, piece.size(), pipe)) {
    output.append(piece.data(), size);
  }
  ok = pclose(pipe) == 0;
  return output;
}

}  // namespace

PostgresServer& PostgresServer::Shared() {
  static PostgresServer server;
  return server;
}

PostgresServer::PostgresServer() {
  if (geteuid() == 0) {
    const passwd* const nobody = getpwnam("nobody");
    if (nobody == nullptr || chown(folder_.path().c_str(), nobody->pw_uid, nobody->pw_gid) != 0) {
      Fail("no user nobody");
    }
  }
  std::vector<std::string> command = AsUser();
  command.insert(command.end(),
                 {Program("initdb"), "--data-checksums", "--auth=trust", "--username=plumescout",
                  "--encoding=UTF8", "--no-locale", "--no-sync", "--no-instructions",
                  "--pgdata=" + folder_.File("data")});
  RunToEnd(command, "/dev/null");
  Start();
}

PostgresServer::~PostgresServer() {
  if (process_ > 0) Kill();
}

void PostgresServer::Start() {
  std::vector<std::string> command = AsUser();
  command.insert(command.end(),
                 {Program("postgres"), "-D", folder_.File("data"), "-k", folder_.path(), "-h", "",
                  "-F", "-c", "shared_buffers=16MB", "-c", "log_min_messages=panic"});
  process_ = Spawn(command, "/dev/null");
  for (int i = 0; i < kStartTries; ++i) {
    if (Ask("", "SELECT 1") == "1") return;
    usleep(50'000);
  }
  Fail("PostgreSQL does not answer");
}

void PostgresServer::Kill() {
  kill(process_, SIGQUIT);
  waitpid(process_, nullptr, 0);
  process_ = 0;
}

std::string PostgresServer::NewUrl() {
  const std::string schema = absl::StrCat("store", ++schemas_);
  Ask("", "CREATE SCHEMA " + schema);
  return absl::StrCat("postgresql:///postgres?host=", folder_.path(),
                      "&user=plumescout&options=-csearch_path%3D", schema);
}

std::string PostgresServer::Ask(const std::string& url, const std::string& sql) {
  const std::string at =
      url.empty() ? absl::StrCat("postgresql:///postgres?host=", folder_.path(), "&user=plumescout")
                  : url;
  bool ok = false;
  std::string output =
      Output(absl::StrCat("env -u LD_PRELOAD psql -XqAt '", at, "' -c \"", sql, "\" 2>&1"), ok);
  return std::string(absl::StripSuffix(output, "\n"));
}

}  // namespace plumescout
