// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/exit_timer.h"

#include <unistd.h>

#include "absl/strings/str_cat.h"
#include "server/base/log.h"

namespace plumescout::server {
namespace {

constexpr absl::Duration kLastLinePatience = absl::Milliseconds(100);

}  // namespace

ExitTimer::ExitTimer(absl::Duration limit, int exit_code)
    : thread_([this, limit, exit_code] {
        if (in_time_.WaitForNotificationWithTimeout(limit)) return;
        LogWarning("stopped with work unfinished",
                   {{"after_s", absl::StrCat(absl::ToDoubleSeconds(limit))}});
        FlushLog(kLastLinePatience);
        _exit(exit_code);
      }) {}

ExitTimer::~ExitTimer() {
  in_time_.Notify();
  thread_.join();
}

}  // namespace plumescout::server
