// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/mission_options.h"

#include <memory>
#include <utility>

#include "core/plan/strategy.h"
#include "core/types/status_macros.h"
#include "formats/map_server.h"
#include "proto/convert/field.h"
#include "proto/convert/options.h"

namespace plumescout::server {
namespace {

absl::Status ReadFiles(const v1::PriorMap& proto, absl::string_view field,
                       MissionOptions& options) {
  if (!proto.has_files()) return absl::OkStatus();
  absl::StatusOr<Grid<CellState>> map = ParseMapServer(proto.files().yaml(), proto.files().pgm());
  if (!map.ok()) {
    return WithField(absl::InvalidArgumentError(map.status().message()), Join(field, "files"));
  }
  options.prior_map = std::make_shared<const Grid<CellState>>(*std::move(map));
  return absl::OkStatus();
}

}  // namespace

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
  PLUMESCOUT_RETURN_IF_ERROR(ReadFiles(proto.prior_map(), Join(field, "prior_map"), base));
  return FromProto(proto, base, field);
}

}  // namespace plumescout::server
