// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "core/belief/belief.h"
#include "core/types/grid.h"
#include "core/types/rng.h"
#include "proto/convert/map.h"

namespace plumescout::server {

struct RandomMap {
  Grid<CellState> states;
  Grid<float> values;
};

inline float RandomGas(Rng& rng) {
  return static_cast<float>(rng.Below(1'000'000)) * 1e-3f - 10.0f;
}

// A third of the cells each is unknown, free and occupied; free ones have a value.
inline RandomMap MakeRandomMap(const GridGeometry& geometry, Rng& rng) {
  RandomMap map{Grid<CellState>(geometry),
                Grid<float>(geometry, std::numeric_limits<float>::quiet_NaN())};
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    map.states[i] = static_cast<CellState>(rng.Below(3));
    if (map.states[i] == CellState::kFree) map.values[i] = RandomGas(rng);
  }
  return map;
}

// A belief that says so, for readers of maps: there is nothing to plan on.
inline std::shared_ptr<const Belief> BeliefOf(std::int64_t revision,
                                              std::shared_ptr<const Grid<CellState>> occupancy,
                                              std::shared_ptr<const Grid<float>> mean,
                                              std::shared_ptr<const Grid<float>> variance) {
  auto belief = std::make_shared<Belief>();
  belief->revision = revision;
  belief->options = std::make_shared<const MissionOptions>();
  belief->traversable =
      std::make_shared<const Grid<std::uint8_t>>(occupancy->geometry(), std::uint8_t{0});
  belief->occupancy = std::move(occupancy);
  belief->gas_mean_ppm = std::move(mean);
  belief->gas_variance_ppm2 = std::move(variance);
  return belief;
}

inline std::shared_ptr<const Belief> BeliefOf(std::int64_t revision, const RandomMap& map) {
  const auto values = std::make_shared<const Grid<float>>(map.values);
  return BeliefOf(revision, std::make_shared<const Grid<CellState>>(map.states), values, values);
}

}  // namespace plumescout::server
