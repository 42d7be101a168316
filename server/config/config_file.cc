// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/config_file.h"

#include <yaml-cpp/yaml.h>

#include <fstream>
#include <sstream>

#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "server/config/config_table.h"
#include "server/config/message_field.h"
#include "server/config/mission_options.h"

namespace plumescout::server {
namespace {

constexpr char kMission[] = "mission";

absl::Status At(absl::string_view name, const YAML::Mark& mark, absl::string_view what) {
  return absl::InvalidArgumentError(absl::StrCat(name, ":", mark.line + 1, ": ", what));
}

absl::Status AddNode(const YAML::Node& node, absl::string_view name, const std::string& prefix,
                     ConfigBuilder& builder);

// Sets the scalar under `key`, or every one below it. `mark` is where the key stands.
absl::Status AddValue(const YAML::Node& value, const YAML::Mark& mark, absl::string_view name,
                      const std::string& key, ConfigBuilder& builder) {
  if (value.IsMap()) return AddNode(value, name, key, builder);
  if (value.IsScalar()) {
    const absl::Status set = builder.Set(key, value.Scalar());
    return set.ok() ? set : At(name, mark, set.message());
  }
  if (!value.IsSequence()) return At(name, mark, absl::StrCat(key, " has no value"));
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (!value[i].IsMap()) return At(name, mark, absl::StrCat(key, " has no value"));
    PLUMESCOUT_RETURN_IF_ERROR(AddNode(value[i], name, absl::StrCat(key, "[", i, "]"), builder));
  }
  return absl::OkStatus();
}

// Sets every scalar below `node` under its dotted key.
absl::Status AddNode(const YAML::Node& node, absl::string_view name, const std::string& prefix,
                     ConfigBuilder& builder) {
  for (const auto& entry : node) {
    const std::string key = Join(prefix, entry.first.Scalar());
    PLUMESCOUT_RETURN_IF_ERROR(AddValue(entry.second, entry.first.Mark(), name, key, builder));
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status ConfigBuilder::AddYaml(const std::string& yaml, absl::string_view name) {
  YAML::Node root;
  try {
    root = YAML::Load(yaml);
  } catch (const YAML::Exception& error) {
    return At(name, error.mark, error.msg);
  }
  if (root.IsNull()) return absl::OkStatus();
  if (!root.IsMap()) return At(name, root.Mark(), "must be a mapping");
  return AddNode(root, name, "", *this);
}

absl::Status ConfigBuilder::AddFile(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) return absl::NotFoundError(absl::StrCat(path, " cannot be read"));
  return AddYaml(text.str(), path);
}

absl::Status ConfigBuilder::Set(absl::string_view key, const std::string& text) {
  for (const ConfigRow& row : ConfigTable(config_)) {
    if (row.key == key) return SetRow(row, text);
  }
  absl::Status status = absl::NotFoundError("");
  absl::string_view path = key;
  if (absl::ConsumePrefix(&path, absl::StrCat(kMission, "."))) {
    status = SetMessageField(mission_, path, text);
  }
  if (absl::IsNotFound(status)) {
    return absl::InvalidArgumentError(absl::StrCat(key, " is not an option"));
  }
  if (status.ok()) return status;
  return absl::InvalidArgumentError(absl::StrCat(key, " ", status.message()));
}

absl::StatusOr<ServerConfig> ConfigBuilder::Build() const {
  ServerConfig config = config_;
  PLUMESCOUT_ASSIGN_OR_RETURN(config.mission,
                              ReadMissionOptions(mission_, MissionOptions{}, kMission));
  if (config.limits.stream_window_observations > config.limits.max_queued_observations ||
      config.limits.max_batch_observations > config.limits.max_queued_observations) {
    return absl::InvalidArgumentError(
        absl::StrCat("limits.max_queued_observations = ", config.limits.max_queued_observations,
                     " must hold a batch and the window of a stream"));
  }
  return config;
}

}  // namespace plumescout::server
