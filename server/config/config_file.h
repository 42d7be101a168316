// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "plumescout/config/v1/server_config.pb.h"
#include "server/config/config.h"

namespace plumescout::server {

// Collects settings from files and flags, then makes a configuration of them; later ones win.
// Errors are kInvalidArgument and name the place: "server.yaml:12: limits.max_mision is not an
// option".
class ConfigBuilder {
 public:
  // `yaml` is a mapping of keys to scalars, mappings, and lists of mappings, whose elements are set
  // one by one; `name` is for errors.
  absl::Status AddYaml(const std::string& yaml, absl::string_view name);
  absl::Status AddFile(const std::string& path);
  // "limits.max_missions" and "mission.gas.refresh_period_s" alike.
  absl::Status Set(absl::string_view key, const std::string& text);

  absl::StatusOr<ServerConfig> Build() const;

 private:
  // `place`: for errors, "server.yaml:12: " or nothing.
  absl::Status SetAt(const std::string& place, absl::string_view key, const std::string& text);

  config::v1::ServerConfig proto_;
  std::map<std::string, std::string> places_;  // of each option set
};

}  // namespace plumescout::server
