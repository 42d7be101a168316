// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "server/base/periodic_task.h"

namespace plumescout::server {

// What a service manager that started this program (systemd, Type=notify) is told: that the server
// serves, in words how it is, that it stops, and, if it asks (WatchdogSec), that it is alive.
// Without such a manager nothing happens.
class ServiceManager {
 public:
  // The server serves from now on. `state` says how it is, in one line for `systemctl status`, and
  // is asked on another thread twice in the manager's time for signs of life: if it does not
  // return, no more signs are given, and the manager ends the program.
  explicit ServiceManager(std::function<std::string()> state);
  // The server stops.
  ~ServiceManager();
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;

 private:
  const std::function<std::string()> state_;
  std::unique_ptr<PeriodicTask> signs_of_life_;  // null: nobody asks for them
};

}  // namespace plumescout::server
