// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lab/report/canvas.h"

namespace plumescout::lab {

// Centres for discs of one radius, one for each place: the place itself, or the nearest of a few
// positions around it where the disc lies in the bounds and meets no disc before it. If there is
// none, the place. Cost: O(places squared).
std::vector<PixelPoint> SpreadDiscs(std::span<const PixelPoint> places, double radius_px,
                                    const PixelBox& bounds);

}  // namespace plumescout::lab
