// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/map_snapshot.h"
#include "lab/formats/scene.h"

namespace plumescout::lab {

// How far a map was from the truth at one time.
struct ErrorPoint {
  double time_s = 0.0;
  double rmse_ppm = 0.0;

  friend bool operator==(const ErrorPoint&, const ErrorPoint&) = default;
};
using ErrorCurve = std::vector<ErrorPoint>;  // ascending in time

// Root mean square error of a map's mean over all free cells of the scene, [IPP] Eq. (14). Where
// the map has no estimate it counts as saying `background_ppm`. The map's grid may lie otherwise:
// a true cell is looked up by the position of its centre. NaN if the scene has no free cell.
double FieldRmse_ppm(const Scene& truth, const MapSnapshot& map, double background_ppm = 0.0);

}  // namespace plumescout::lab
