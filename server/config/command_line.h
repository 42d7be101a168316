// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "server/config/config.h"

namespace plumescout::server {

struct CommandLine {
  ServerConfig config;
  std::optional<std::string> print;  // print this and leave: help or version
};

// Reads the flags and the configuration file they name. kInvalidArgument says what is wrong with
// them.
absl::StatusOr<CommandLine> ReadCommandLine(int argc, const char* const* argv);

}  // namespace plumescout::server
