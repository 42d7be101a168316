// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/cell.h"
#include "core/types/map_snapshot.h"
#include "core/types/pose2.h"
#include "lab/formats/scene.h"

namespace plumescout::lab {

// How good a map is, [XIT] section VI-B. A scene without critical cells has no errors to tell:
// rmse_ppm, rmse_zero_ppm and entropy_nats are NaN then.
struct MapMetrics {
  double completeness = 0.0;   // known-free share of the reachable free cells, [0, 1]
  double rmse_ppm = 0.0;       // [XIT] Eq. (23)
  double rmse_zero_ppm = 0.0;  // the same for a map that says 0 (clean air) everywhere
  double entropy_nats = 0.0;   // [XIT] Eq. (24), in all
  int critical_cells = 0;
};

// Judges maps against a scene. The map's grid may lie and be spaced otherwise: a true cell is
// looked up by the position of its centre.
class MapEvaluator {
 public:
  // `prior_variance_ppm2` (> 0) stands in where the map has no estimate, see Evaluate; usually
  // OpenLatticeVariance_ppm2 of the mission. `ambient_ppm` is in all air beside the scene's gas:
  // the truth is the sum, and clean air is what a map without an estimate says.
  MapEvaluator(const Scene& scene, double prior_variance_ppm2, double ambient_ppm = 0.0);

  // Over critical cells, free ones with a true mean of the scene's gas above the scene's threshold:
  //   where the map holds no estimate (unknown, NaN, beyond its edge) it counts as clean air with
  //   the prior's variance. The paper is silent on this; its map must say something there too, and
  //   leaving the cells out would reward a robot for not looking.
  // Completeness counts the free cells that the start is connected to (4 neighbours), before
  // inflation: cells that no beam can reach are nobody's failure.
  MapMetrics Evaluate(const MapSnapshot& map) const;

 private:
  struct CriticalCell {
    Point2 center;
    double truth_ppm = 0.0;
  };

  double prior_variance_ppm2_;
  double ambient_ppm_;
  std::vector<Point2> reachable_;
  std::vector<CriticalCell> critical_;
};

}  // namespace plumescout::lab
