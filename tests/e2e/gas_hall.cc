// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/e2e/gas_hall.h"

#include "lab/sim/layout.h"
#include "lab/sim/scene_maker.h"

namespace plumescout::lab {
namespace {

Layout GasHallLayout() {
  Layout layout;
  layout.name = "gas_hall";
  layout.size_x_m = 6.0;
  layout.size_y_m = 5.0;
  layout.walls = {{{3.0, 0.0}, {3.0, 5.0}, 0.2, {{3.6, 1.4}}}};
  layout.boxes = {{{4.2, 1.6}, {4.8, 2.2}}};
  layout.openings = {{Side::kWest, 3.0, 4.2, 1.0}, {Side::kEast, 1.0, 2.2, std::nullopt}};
  layout.sources = {{0, 3.6, 3.4, 0.4, 1000.0}};
  layout.start_pose = {0.8, 0.8, 0.0};
  return layout;
}

}  // namespace

absl::StatusOr<Scene> MakeGasHall() {
  SceneMakerOptions options;
  options.wind.flow_s = 4.0;
  options.warm_up_s = 30.0;
  options.frames = 80;
  return MakeScene(GasHallLayout(), options);
}

}  // namespace plumescout::lab
