// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "lab/formats/scene_folder.h"
#include "lab/trials/study.h"
#include "tests/lab/sim/small_scene.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {

// One trial of 60 s in the small room; the scene is written to `folder`, as trials will be.
inline ExperimentOptions SmallStudy(const TempFolder& folder) {
  ExperimentOptions options;
  options.quick = true;
  options.trials = 1;
  options.folder = folder.path();
  options.scenes = {folder.File("small")};
  EXPECT_TRUE(WriteScene(SmallScene(), options.scenes.front()).ok());
  return options;
}

}  // namespace plumescout::lab
