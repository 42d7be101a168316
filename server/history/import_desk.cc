// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/import_desk.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/base/errors.h"

namespace plumescout::server {

ImportDesk::ImportDesk(MissionStore* store, MissionRegistry* registry, const ImportLimits& limits)
    : store_(*store),
      registry_(*registry),
      limits_(limits),
      // Of each import one task at a time.
      pool_({.name = "import", .threads = 1, .max_queued = 2 * limits.max_at_once}) {}

absl::StatusOr<std::unique_ptr<MissionImport>> ImportDesk::Open() {
  std::shared_ptr<void> place;
  {
    absl::MutexLock lock(&mutex_);
    if (open_ >= limits_.max_at_once) {
      return Overloaded(absl::StrCat("the server takes ", open_, " imports already"));
    }
    ++open_;
    place = std::shared_ptr<void>(nullptr, [this](void*) {
      absl::MutexLock release(&mutex_);
      --open_;
    });
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(SpoolFile file, SpoolFile::Create(limits_.folder));
  return std::make_unique<MissionImport>(store_, registry_, limits_, std::move(file),
                                         std::move(place));
}

}  // namespace plumescout::server
