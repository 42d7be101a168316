// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/service_manager.h"

#include <systemd/sd-daemon.h>

#include <cstdint>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/time/time.h"

namespace plumescout::server {
namespace {

constexpr int kKeepEnvironment = 0;

// A manager that is not there or does not listen changes nothing.
void Tell(const std::string& words) { sd_notify(kKeepEnvironment, words.c_str()); }

}  // namespace

ServiceManager::ServiceManager(std::function<std::string()> state) : state_(std::move(state)) {
  Tell(absl::StrCat("READY=1\nSTATUS=", state_()));
  std::uint64_t patience_us = 0;
  if (sd_watchdog_enabled(kKeepEnvironment, &patience_us) <= 0) return;
  signs_of_life_ = std::make_unique<PeriodicTask>(
      absl::Microseconds(static_cast<std::int64_t>(patience_us)) / 2,
      [this] { Tell(absl::StrCat("WATCHDOG=1\nSTATUS=", state_())); });
}

ServiceManager::~ServiceManager() {
  signs_of_life_.reset();
  Tell("STOPPING=1\nSTATUS=stopping");
}

}  // namespace plumescout::server
