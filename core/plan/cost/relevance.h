// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/belief/belief.h"
#include "core/types/cell_rect.h"
#include "core/types/grid.h"
#include "core/types/options.h"
#include "core/types/stop.h"

namespace plumescout {

// Of a cell without gas: low, so that readings are not spent on clean air, but more than nothing,
// for gas may be anywhere.
inline constexpr float kCleanRelevance = 0.05F;

// How much it matters what a cell's gas is, by the mean that is estimated there (ours):
//
//   kCleanRelevance + (1 - kCleanRelevance) min(1, s)^2 + 1/2 min(1, c / (max c))
//
// with c = max(0, mu - m_0), max c that of the means, and s = c / (twice tau_gas,min), or how far
// mu is on the way from m_0 to the fixed threshold if the mission has one. The first part is about
// which cells hold gas at all: maps are judged where they do. The last is about errors, which grow
// with concentration. Square and factor were found by trial (docs/decisions/0007-own-strategy.md):
// a sharper edge is lost in the field's smoothness, a softer one spends readings around the gas.
// Where the mean is NaN: kCleanRelevance. By cell, in [kCleanRelevance, 1.5]; of `cells` alone, row
// by row. Of no use once `stop`, which is asked all along, says so. Cost: O(cells).
std::vector<float> Relevance(const Grid<float>& mean_ppm, const MissionOptions& options,
                             const CellRect& cells, const StopFn& stop = {});
std::vector<float> Relevance(const Grid<float>& mean_ppm, const MissionOptions& options);

// The same of a mission. Where published variances know the level (HasNoiseByLevel) mu is the mean
// and the root of the variance by LevelScale: what nobody has read may hold gas, most of all beside
// gas (docs/decisions/0033-relevance-by-what-may-be-there.md). And by what the mission is for: of
// another objective than a complete map, cells that are decided (JudgeCells) have none. Then in {0}
// and [kCleanRelevance, 1.5].
std::vector<float> Relevance(const Belief& belief, const CellRect& cells, const StopFn& stop = {});
std::vector<float> Relevance(const Belief& belief);

}  // namespace plumescout
