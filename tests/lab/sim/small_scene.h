// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/sim/scene_maker.h"
#include "lab/sim/scene_world.h"
#include "tests/lab/sim/small_layout.h"

namespace plumescout::lab {

// Twenty seconds of gas in the small room.
inline Scene SmallScene() {
  SceneMakerOptions options;
  options.wind.flow_s = 2.0;
  options.warm_up_s = 5.0;
  options.frames = 40;
  return MakeScene(SmallLayout(), options).value();
}

inline const SceneWorld& SmallWorld() {
  static const SceneWorld world(SmallScene());
  return world;
}

}  // namespace plumescout::lab
