// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/past_missions.h"

#include "absl/strings/str_cat.h"
#include "core/types/error_reason.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "server/base/errors.h"
#include "server/missions/mission_recovery.h"

namespace plumescout::server {

absl::Status ReplayDiffers(std::int64_t number, const absl::Status& why) {
  return TypedError(absl::StatusCode::kDataLoss, reason::kStoreDamaged,
                    absl::StrCat("event ", number, " of the journal: ", why.message()));
}

absl::StatusOr<PastMission> PastMissions::Make(const MissionHost& host, std::int64_t revision,
                                               absl::string_view field, PastUse use,
                                               const StopFn& stop) {
  const std::string key = KeyOf(host);
  PLUMESCOUT_ASSIGN_OR_RETURN(const AcquiredMission stored, store_.Peek(key));
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative(field, static_cast<double>(revision)));
  if (revision > stored.head) {
    return NotYetError(field, revision,
                       absl::StrCat("must be at most ", stored.head, ", what is durable"));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto place, TakePlace({key, use}));
  PLUMESCOUT_ASSIGN_OR_RETURN(auto memory, registry_.HoldRoom(host.options().memory_budget_bytes));
  PastMission past;
  past.room = std::shared_ptr<void>(nullptr, [place, memory](void*) {});
  PLUMESCOUT_ASSIGN_OR_RETURN(past.mission, MissionAt(store_, key, revision, stop));
  past.mission->AbandonWhen(stop);
  return past;
}

absl::StatusOr<std::shared_ptr<void>> PastMissions::TakePlace(const Place& place) {
  absl::MutexLock lock(&mutex_);
  if (!taken_.insert(place).second) {
    return Overloaded(absl::StrCat("a past state of mission ", place.first,
                                   " is being looked at; there is one at a time"));
  }
  return std::shared_ptr<void>(nullptr, [this, place](void*) {
    absl::MutexLock release(&mutex_);
    taken_.erase(place);
  });
}

}  // namespace plumescout::server
