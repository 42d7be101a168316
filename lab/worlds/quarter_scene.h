// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "absl/status/statusor.h"
#include "core/types/pose2.h"
#include "lab/formats/scene.h"
#include "lab/worlds/quarter_plan.h"

namespace plumescout::lab {

// The stage of [IPP] section IV, in place of the DAPPLE data, which are not public: a quarter of
// streets and blocks, steady wind from the west, one source among the houses that has released gas
// for so long that its plume stands, and 10,000 s of that plume in an air that is never quite
// still.
struct QuarterWorld {
  Scene scene;  // conc_mean_ppm is the mean over the 10,000 s: the truth of Eq. (14)
  BuiltUpArea built_up;
  // Ten places to start from, in and out of the plume, among the houses and not; the scene's start
  // is the first.
  std::vector<Point2> starts;
};

// How it is made:
//   wind    the flow of SolveWind in a channel without friction on its sides, half of it, and half
//           that of an ideal fluid. No air goes over the roofs of a flat solver, so the quarter's
//           wake would be as long as the raster and fill with gas; real wakes are dragged along
//           from above.
//   gusts   a wind across it, through the same streets, is somewhat oblique in the mean and comes
//           and goes, an Ornstein-Uhlenbeck process: the plume meanders.
//   gas     SteadyConcentration in the wind with as much of the cross-wind as blows; in between, it
//           is interpolated. So the plume follows the wind at once, though it is minutes long.
//   units   root mean square of the truth over the free cells: 20 ppm. The paper's unit is not
//           stated; its maps count as resolved at an RMSE of 0.0095 units, at which a map of zeros
//           surely is not. One of its units is 1000 ppm here. Since posterior means are linear in
//           the readings, the scale only matters beside the noise of the sensor.
// The same seed gives the same world. Errors: those of SolveWind and SteadyConcentration. Cost:
// some 2.5 s.
absl::StatusOr<QuarterWorld> MakeQuarterWorld(std::uint64_t seed);

}  // namespace plumescout::lab
