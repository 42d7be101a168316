// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/belief/belief.h"
#include "core/types/cell_state.h"
#include "core/types/event.h"
#include "core/types/grid.h"
#include "core/types/options.h"

namespace plumescout {

// The goals of a mission that led nowhere. One that was blocked is set aside; so is one that was
// reached kVisitsBeforeSetAside times in a row and is still offered: visits count from anew if
// set_aside_s went by since the last one, or the map near the goal has become another after it, or,
// for a place visited for the readings, their variance there has fallen by a tenth: that it falls
// for ever is impossible, so such a place is done with at last, or set aside.
// That a goal is unreachable needs no memory: every plan finds it out anew.
//
// A goal stays set aside until planning.set_aside_s are over, or the map near it has become
// another: at least frontier.min_occupancy_cell_count cells within kChangeRadius_m are in another
// state than they were when it was set aside. Cells that change and change back count for nothing,
// so neither flicker nor the passing of time adds up to a change. Thread-compatible.
class GoalMemory {
 public:
  // The mission at present.
  struct Now {
    std::int64_t time_ns;  // of samples
    const Grid<CellState>& map;
    const Grid<float>& gas_variance_ppm2;  // as of the last refresh; its geometry may be older
  };

  explicit GoalMemory(const MissionOptions& options)
      : set_aside_s_(options.planning.set_aside_s),
        min_changed_cells_(options.frontier.min_occupancy_cell_count) {}

  // A plan to `goal` ended. Cost: O(cells within kChangeRadius_m + kMaxSetAside).
  void Remember(const Goal& goal, ProgressOutcome outcome, const Now& now);

  // Cost: O(goals set aside * cells within kChangeRadius_m).
  std::vector<SetAsideGoal> SetAside(const Now& now) const;

  // See core/types/byte_archive.h.
  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self);
  // Whether what it remembers was seen on maps of this resolution.
  bool IsOf(double resolution_m) const;

 private:
  struct VisitedGoal {
    Goal goal;
    int visits = 0;
    std::int64_t last_ns = 0;
    // At the last visit: of the map near the goal, and of the gas in its cell, NaN if unknown.
    std::vector<CellState> states_then;
    float variance_then_ppm2 = 0.0F;

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };
  struct Entry {
    SetAsideGoal aside;
    std::vector<CellState> states_then;  // of the map near the goal

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };

  bool HasNews(const VisitedGoal& visited, const Now& now) const;
  void RememberVisit(const Goal& goal, const Now& now);
  void Add(const Goal& goal, const std::string& reason, const Now& now);
  bool Holds(const Entry& entry, const Now& now) const;

  double set_aside_s_;
  int min_changed_cells_;
  std::vector<VisitedGoal> visited_;
  std::vector<Entry> set_aside_;
};

}  // namespace plumescout
