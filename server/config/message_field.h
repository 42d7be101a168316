// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "google/protobuf/message.h"

namespace plumescout::server {

// Sets the scalar field at `path` ("gas.refresh_period_s") from text, as configuration files write
// it: true and false, numbers, and enum values by the end of their name in lower case ("gas_first"
// for GOAL_POLICY_GAS_FIRST). Of a list of messages "keep_out[0].x_m" means an element; the one
// after the last is added. kNotFound if there is no such field; kInvalidArgument, without the path,
// if the text is no value of it.
absl::Status SetMessageField(google::protobuf::Message& message, absl::string_view path,
                             const std::string& text);

}  // namespace plumescout::server
