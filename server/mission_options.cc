// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/mission_options.h"

#include "core/plan/strategy.h"
#include "proto/convert/field.h"
#include "proto/convert/options.h"

namespace plumescout::server {

absl::StatusOr<MissionOptions> ReadMissionOptions(const v1::MissionOptions& proto,
                                                  const MissionOptions& defaults,
                                                  absl::string_view field) {
  MissionOptions base = defaults;
  if (proto.planning().has_strategy()) {
    base.planning.strategy = proto.planning().strategy();
    if (!ApplyStrategyRow(base.planning).ok()) {
      return FieldError(Join(field, "planning.strategy"), proto.planning().strategy(),
                        "is not a strategy");
    }
  }
  return FromProto(proto, base, field);
}

}  // namespace plumescout::server
