// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/config_file.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "server/config/config_convert.h"
#include "server/config/option_path.h"

namespace plumescout::server {
namespace {

// Beyond the deepest option. An alias may name a mapping that it stands in, which has no end.
constexpr int kMaxDepth = 8;

std::string Place(absl::string_view name, const YAML::Mark& mark) {
  return absl::StrCat(name, ":", mark.line + 1, ": ");
}

absl::Status At(absl::string_view name, const YAML::Mark& mark, absl::string_view what) {
  return absl::InvalidArgumentError(absl::StrCat(Place(name, mark), what));
}

// Sets one option from its text; the first argument is the place where it stands, for errors.
using Setter = std::function<absl::Status(const std::string&, const std::string&,  // place, key
                                          const std::string&)>;

// A file and what becomes of its scalars.
class YamlReader {
 public:
  YamlReader(absl::string_view name, Setter set) : name_(name), set_(std::move(set)) {}

  // Sets every scalar below `node` under its dotted key.
  absl::Status AddNode(const YAML::Node& node, const std::string& prefix) {
    for (const auto& entry : node) {
      const std::string key = Join(prefix, entry.first.Scalar());
      PLUMESCOUT_RETURN_IF_ERROR(AddValue(entry.second, entry.first.Mark(), key));
    }
    return absl::OkStatus();
  }

 private:
  // Sets the scalar under `key`, or every one below it. `mark` is where the key stands.
  absl::Status AddValue(const YAML::Node& value, const YAML::Mark& mark, const std::string& key) {
    if (std::count(key.begin(), key.end(), '.') >= kMaxDepth) {
      return At(name_, mark, absl::StrCat(key, " is not an option"));
    }
    if (value.IsMap()) return AddNode(value, key);
    if (value.IsScalar()) return set_(Place(name_, mark), key, value.Scalar());
    if (!value.IsSequence()) return At(name_, mark, absl::StrCat(key, " has no value"));
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (!value[i].IsMap()) return At(name_, mark, absl::StrCat(key, " has no value"));
      PLUMESCOUT_RETURN_IF_ERROR(AddNode(value[i], absl::StrCat(key, "[", i, "]")));
    }
    return absl::OkStatus();
  }

  absl::string_view name_;
  Setter set_;
};

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
  const auto set = [this](const std::string& place, const std::string& key,
                          const std::string& text) { return SetAt(place, key, text); };
  return YamlReader(name, set).AddNode(root, "");
}

absl::Status ConfigBuilder::AddFile(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) return absl::NotFoundError(absl::StrCat(path, " cannot be read"));
  return AddYaml(text.str(), path);
}

absl::Status ConfigBuilder::Set(absl::string_view key, const std::string& text) {
  return SetAt("", key, text);
}

absl::Status ConfigBuilder::SetAt(const std::string& place, absl::string_view key,
                                  const std::string& text) {
  const absl::Status status = SetOption(proto_, key, text);
  if (absl::IsNotFound(status)) {
    return absl::InvalidArgumentError(absl::StrCat(place, key, " is not an option"));
  }
  if (!status.ok()) {
    return absl::InvalidArgumentError(absl::StrCat(place, key, " ", status.message()));
  }
  places_[std::string(key)] = place;
  return absl::OkStatus();
}

absl::StatusOr<ServerConfig> ConfigBuilder::Build() const {
  absl::StatusOr<ServerConfig> config = ServerConfigFromProto(proto_);
  if (config.ok()) return config;
  // Refusals begin with the option's name.
  const absl::string_view message = config.status().message();
  const auto place = places_.find(std::string(message.substr(0, message.find(' '))));
  if (place == places_.end()) return config.status();
  return absl::InvalidArgumentError(absl::StrCat(place->second, message));
}

}  // namespace plumescout::server
