// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lab/report/map_panel.h"
#include "lab/trials/mit_runs.h"
#include "lab/worlds/mit_scene.h"

namespace plumescout::lab {

// Pictures of [MIT] Fig. 1 and 2.

// The field as I-hat with start, goals and the way that was driven.
MapPanel MitScenePanel(const MitScene& scene, std::string title);

// Some runs thin, the most typical of all thick; with the discs that end the trees, if wanted.
MapPanel MitRunsPanel(const MitScene& scene, const std::vector<MitRun>& runs, std::string title,
                      bool discs);

}  // namespace plumescout::lab
