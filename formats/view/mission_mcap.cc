// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/view/mission_mcap.h"

#include <utility>

#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"

namespace plumescout {

MissionMcap::MissionMcap(const JournalStart& start, std::unique_ptr<Mission> mission,
                         double map_period_s, double map_share)
    : mission_(std::move(mission)), map_timer_(map_period_s), view_(start, map_share) {}

absl::Status MissionMcap::Add(const Event& event, absl::string_view record) {
  const absl::StatusOr<Applied> applied = mission_->Apply(event.body);
  if (!applied.ok() || applied->revision != event.number) {
    return absl::DataLossError(
        absl::StrCat("event ", event.number, " does not follow: ", applied.status().message()));
  }
  MissionMoment moment = MomentAfter(event, *applied, *mission_, map_timer_);
  moment.record = std::string(record);
  return view_.Add(std::move(moment));
}

}  // namespace plumescout
