// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/types/grid.h"
#include "core/types/map_snapshot.h"
#include "core/types/objective.h"
#include "core/types/options.h"
#include "core/types/rectangle.h"
#include "lab/report/map_panel.h"
#include "lab/report/text_table.h"

namespace plumescout::lab {

// What a mission was for, and what came of it.
struct ObjectiveOutcome {
  ObjectiveOptions asked;           // of another kind than kCompleteMap
  ObjectiveStatus status;           // in the end
  double since_s = 0.0;             // since when it is that, of the mission's time
  std::string explanation;          // that in a sentence
  Grid<ObjectiveVerdict> verdicts;  // in the end
};

// One row: what was asked, what became of it, how sure that is, when, and the area of each verdict
// with its share of all that counts. REQUIRES: the verdicts have the geometry of `map`, which is
// that of the end.
TextTable ObjectiveTable(const ObjectiveOutcome& outcome, const MapSnapshot& map);

// Where which verdict holds, with the most doubtful place and the strongest. REQUIRES: as above.
MapPanel ObjectivePanel(const ObjectiveOutcome& outcome, const MapSnapshot& map,
                        const Rectangle& region);

}  // namespace plumescout::lab
