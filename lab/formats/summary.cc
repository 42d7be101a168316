// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/summary.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "formats/file_io.h"

namespace plumescout::lab {

absl::Status WriteSummary(const Summary& summary, const std::string& path) {
  using Json = nlohmann::ordered_json;
  Json json = Json::object();
  for (const auto& [name, value] : summary.figures) {
    if (name.empty() || name == "about" || json.contains(name)) {
      return absl::InvalidArgumentError(
          absl::StrCat(path, ": figure \"", name, "\" is empty, reserved or there twice"));
    }
    if (std::isfinite(value)) json[name] = value;
  }
  Json about = Json::object();
  for (const auto& [name, value] : summary.about) about[name] = value;
  json["about"] = about;
  constexpr int kIndent = 2;
  return WriteFile(path, json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace plumescout::lab
