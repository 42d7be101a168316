// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "absl/status/statusor.h"

namespace plumescout::client {

using Json = nlohmann::json;
using Answer = absl::StatusOr<Json>;

// Does a step of that kind with these arguments; see README.md.
using Steps = std::function<Answer(const std::string& kind, const Json& with)>;

// The steps by the C++ client, over one connection.
Steps MakeSteps(const std::string& target, Json scenario);

}  // namespace plumescout::client
