// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lab/formats/scene.h"
#include "lab/report/image.h"
#include "lab/report/map_panel.h"

namespace plumescout::lab {

// Panels of a scene: its map with openings, sources and start; the wind, if it is known; the mean
// gas with the outline of its critical cells. REQUIRES: the scene is valid.
std::vector<MapPanel> MakeScenePanels(const Scene& scene);

// The panels side by side under the scene's name and figures.
Image DrawSceneSheet(const Scene& scene);

}  // namespace plumescout::lab
