// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <csignal>
#include <string>

#include "tests/support/temp_folder.h"

namespace plumescout {

// A server of Debian's PostgreSQL in a folder of its own, with checksums of pages, reached by a
// Unix socket. Nothing waits for the disk. It ends with the program, however that ends.
class PostgresServer {
 public:
  // One for the whole program; aborts if there is no PostgreSQL.
  static PostgresServer& Shared();

  PostgresServer();
  ~PostgresServer();
  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;

  // Of an empty store: a schema of its own in the one database.
  std::string NewUrl();
  // What psql prints of the statements, run in the schema of that URL.
  std::string Ask(const std::string& url, const std::string& sql);

  // Waits until it answers.
  void Start();
  // As after a loss of power: connections break, and what was committed is there at the next start.
  void Kill();
  bool is_running() const { return process_ > 0; }

 private:
  const TempFolder folder_;
  pid_t process_ = 0;
  int schemas_ = 0;
};

}  // namespace plumescout
