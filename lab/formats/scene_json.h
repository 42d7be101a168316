// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "lab/formats/scene.h"

namespace plumescout::lab {

// Files of the scene's own folder that scene.json names.
struct SceneFiles {
  std::string series;
  std::optional<std::string> wind;
};

// What scene.json says: a scene whose arrays are still to be read.
struct SceneDescription {
  Scene scene;  // `occupancy` has its geometry but is unknown; the other rasters are empty
  SceneFiles files;
};

// kDataLoss if the text is no JSON; kInvalidArgument, naming the field, if one is missing, of
// another type or out of range. The scene has at most 2^26 cells.
absl::StatusOr<SceneDescription> ParseSceneJson(absl::string_view text);

// The text for `scene` with its arrays in `files`; numbers survive a round trip exactly.
std::string FormatSceneJson(const Scene& scene, const SceneFiles& files);

}  // namespace plumescout::lab
