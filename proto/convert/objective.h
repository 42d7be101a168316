// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/objective.h"
#include "plumescout/v1/types.pb.h"

namespace plumescout {

// Without the explanation.
v1::ObjectiveStatus ToProto(const ObjectiveStatus& status);

// kInvalidArgument naming the field.
absl::StatusOr<ObjectiveStatus> FromProto(const v1::ObjectiveStatus& proto,
                                          absl::string_view field);

}  // namespace plumescout
