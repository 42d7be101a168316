// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/options.h"
#include "plumescout/v1/options.pb.h"

namespace plumescout {

// Every field set, but the overrides that are off and what there is none of.
v1::MissionOptions ToProto(const MissionOptions& options);

// Only the fields that differ from MissionOptions{}: what a creator asks for who leaves the rest
// to the server's configuration.
v1::MissionOptions ChangesToProto(const MissionOptions& options);

// `defaults` with the fields that are set in `proto`; an enum that is unspecified counts as unset.
// The result is valid; refusals name the field of `proto`, below `field`. Files of a prior map are
// not read: with files in `proto`, the map that they hold has to stand in `defaults`.
absl::StatusOr<MissionOptions> FromProto(const v1::MissionOptions& proto,
                                         const MissionOptions& defaults, absl::string_view field);

// For options that a journal does not name: its events were made by a version that did not know
// them, and acted so.
MissionOptions RecordedDefaults();

}  // namespace plumescout
