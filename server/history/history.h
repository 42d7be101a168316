// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "server/history/import_desk.h"
#include "server/history/past_figures.h"
#include "server/history/past_maps.h"
#include "server/history/past_missions.h"
#include "server/store/mission_store.h"

namespace plumescout::server {

// All that a server has for looking back at its missions, and for copying them. Thread-safe.
struct History {
  // Not owned; both outlive this and whatever came of it.
  History(MissionStore* mission_store, MissionRegistry* registry, const ImportLimits& limits)
      : store(*mission_store),
        past_missions(mission_store, registry),
        past_maps(&past_missions),
        past_figures(&past_missions),
        imports(mission_store, registry, limits) {}

  MissionStore& store;
  PastMissions past_missions;
  PastMaps past_maps;
  PastFigures past_figures;
  ImportDesk imports;
};

}  // namespace plumescout::server
