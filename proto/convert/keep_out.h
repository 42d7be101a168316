// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/event.h"
#include "core/types/polygon.h"
#include "google/protobuf/repeated_ptr_field.h"
#include "plumescout/v1/mission_service.pb.h"
#include "plumescout/v1/options.pb.h"

namespace plumescout {

using PolygonsProto = google::protobuf::RepeatedPtrField<v1::Polygon>;

// Coordinates must be finite; what else an area has to be is for the core to judge.
absl::StatusOr<std::vector<Polygon>> FromProto(const PolygonsProto& proto, absl::string_view field);
PolygonsProto ToProto(const std::vector<Polygon>& areas);

absl::StatusOr<KeepOutChanged> FromProto(const v1::ChangeKeepOutAreasRequest& request);
// Without the name of the mission.
v1::ChangeKeepOutAreasRequest ToProto(const KeepOutChanged& change);

}  // namespace plumescout
