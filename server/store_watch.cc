// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store_watch.h"

#include <utility>

namespace plumescout::server {

StoreWatch::StoreWatch(const MissionStore* store, absl::Duration period, Changed changed)
    : store_(store), changed_(std::move(changed)), looks_(period, [this] { Look(); }) {}

void StoreWatch::Look() {
  const bool available = store_->state().status.ok();
  if (std::exchange(available_, available) != available) changed_(available);
}

}  // namespace plumescout::server
