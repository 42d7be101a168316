// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/options.h"
#include "plumescout/v1/options.pb.h"

namespace plumescout::server {

// Options of a mission as asked for, over `defaults`: a strategy named in `proto` first sets the
// parts that its row fixes, then the other fields override them. Refusals name fields below
// `field`.
absl::StatusOr<MissionOptions> ReadMissionOptions(const v1::MissionOptions& proto,
                                                  const MissionOptions& defaults,
                                                  absl::string_view field);

}  // namespace plumescout::server
