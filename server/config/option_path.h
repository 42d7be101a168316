// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "google/protobuf/descriptor.h"
#include "google/protobuf/message.h"

namespace plumescout::server {

// Options are the fields of plumescout.config.v1.ServerConfig, named by path:
// "mission.gas.refresh_period_s".

// False for bytes, and for messages that are given in one of several ways: that is data, such as a
// map of the building, which a configuration does not hold.
bool IsOption(const google::protobuf::FieldDescriptor& field);

// "gas_first" for GOAL_POLICY_GAS_FIRST; empty for the value that means unset.
std::string EnumText(const google::protobuf::EnumValueDescriptor& value);

// All of them: "gas_first, occupancy_first".
std::string EnumTexts(const google::protobuf::EnumDescriptor& type);

// Sets the scalar at `path` from text, as configuration files write it: true and false, numbers,
// and EnumText. Of a list of messages "keep_out[0].x_m" means an element; the one after the last is
// added. kNotFound if there is no such option; kInvalidArgument, without the path, if the text is
// no value of it.
absl::Status SetOption(google::protobuf::Message& message, absl::string_view path,
                       const std::string& text);

}  // namespace plumescout::server
