// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <thread>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "server/server.h"

namespace plumescout::server {

// Whether the server's metrics come to have this line before `patience` is over, which is long
// enough for any machine.
inline bool AwaitMetric(const Server& server, absl::string_view line,
                        absl::Duration patience = absl::Seconds(60)) {
  const std::string whole_line = absl::StrCat("\n", line, "\n");
  const absl::Time deadline = absl::Now() + patience;
  while (!absl::StrContains(server.MetricsText(), whole_line)) {
    if (absl::Now() >= deadline) return false;
    std::this_thread::yield();
  }
  return true;
}

}  // namespace plumescout::server
