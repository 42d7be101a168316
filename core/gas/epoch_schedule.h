// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/gas/gas_lattice.h"

namespace plumescout {

// When the field should be made anew though no reading has aged (see AgeingWatch for that), as a
// function of what changed: never of a clock or a machine.
class EpochSchedule {
 public:
  // The long part of an epoch gets this much sample time; a fresh field of 400,000 cells takes
  // about 0.5 s of a core.
  static constexpr std::int64_t kRecompute_ns = 1'000'000'000;
  // Cells around the active ones that a new lattice gets. Half of them are used up before the next
  // one is due, so a map that grows is made anew a number of times that follows its logarithm.
  static int Margin_cells(const GasCellRect& rect);

  // A batch of changes, of which so many made a cell active or not.
  void NoteRefresh(std::int64_t activity_changes);
  // A field was made anew.
  void NoteFresh(std::int64_t active_cells);

  bool IsDue(const GasLattice& lattice, const GasCellRect& rect) const;

  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self);

 private:
  std::int64_t activity_changes_ = 0;  // since the last fresh field
  std::int64_t active_cells_ = 0;      // of that field
  std::int64_t refreshes_ = 0;         // since then
};

}  // namespace plumescout
