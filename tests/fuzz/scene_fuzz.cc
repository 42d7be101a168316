// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Descriptions of scenes: scene.json, or layouts in YAML if the first byte is odd.

#include <cstdint>
#include <string>

#include "lab/formats/scene_json.h"
#include "lab/sim/layout_yaml.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] % 2 == 1) {
    plumescout::lab::ParseLayout(text).status().IgnoreError();
    return 0;
  }
  const auto scene = plumescout::lab::ParseSceneJson(text);
  if (scene.ok()) plumescout::lab::FormatSceneJson(scene->scene, scene->files);
  return 0;
}
