// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "absl/time/time.h"
#include "server/base/periodic_task.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// Looks now and then whether the store takes data. The store is not owned and outlives it.
class StoreWatch {
 public:
  // Told when that has changed, on the thread of the watch. It does at first.
  using Changed = std::function<void(bool available)>;

  // Looks every `period`.
  StoreWatch(const MissionStore* store, absl::Duration period, Changed changed);

 private:
  void Look();

  const MissionStore* const store_;
  const Changed changed_;
  // Of the thread.
  bool available_ = true;

  PeriodicTask looks_;  // last: it uses all of the above
};

}  // namespace plumescout::server
