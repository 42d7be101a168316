// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/gas/field/boundary_memory.h"
#include "core/gas/field/field_factor.h"
#include "core/gas/field/field_shift.h"
#include "core/types/stop.h"

namespace plumescout {

// More evidence in one cell.
struct FieldReading {
  Slot slot = 0;  // active
  double precision = 0.0;
  double weighted_deviation = 0.0;
};

// Mean and marginal variance of every active cell, and the two passes down the tree that keep them
// so: one for any change of the factor, and a cheaper one for a reading.
//
// Inside a subtree whose own fronts have not changed, the fields are averages of their values on
// its boundary, with weights >= 0 that sum to at most 1, plus something constant: if no mean and no
// covariance on the boundary has moved by more than d since the subtree was computed, nothing in it
// has. So each node remembers the boundary it was computed from, and how far its descendants may
// be off already; a subtree for which both together stay within the tolerance is left alone.
// Errors therefore do not add up, neither by depth nor in time.
//
// The same holds for the column x of the covariance that a reading needs: x >= 0, and in a subtree
// without the cell that is read it is nowhere larger than on the boundary. A subtree that has been
// passed over owes what it has missed, until the next pass for changes.
class Marginals {
 public:
  explicit Marginals(const SeparatorTree& tree);

  // Brings the fields to `factor`, whose flagged fronts have changed. Cells that are not active
  // become NaN. Returns how far off the fields may be, at most `tolerance`. Once `stop`, which is
  // asked at every node, says so, the rest is left as it is, and the fields are of no use any more.
  struct Pass {
    FieldShift error;
    bool healthy = true;  // all that was computed is finite, variances positive
    bool stopped = false;
  };
  Pass Descend(const FieldFactor& factor, std::span<const std::uint8_t> dirty,
               const FieldShift& tolerance, const StopFn& stop = {});

  // Brings the fields to what they are after a reading that `factor` has not heard; `steps` are
  // those from its cell. Passes over subtrees that together with earlier readings owe no more than
  // `limit`. The nodes on the path are to be flagged at the next descent. Returns whether all that
  // was computed is healthy.
  bool Hear(const FieldFactor& factor, const FieldReading& reading, std::span<const PathStep> steps,
            const FieldShift& limit);
  // How far the fields may be off through readings since the last descent.
  FieldShift owed() const { return debts_.back().own + debts_.back().below; }

  const std::vector<double>& mean_ppm() const { return mean_ppm_; }  // by slot; deviation from m_0
  const std::vector<double>& variance_ppm2() const { return variance_ppm2_; }
  // The largest absolute mean of all active cells. Cost: O(cells).
  double LargestMean_ppm() const;

 private:
  friend struct FieldEnginePeer;  // of the tests

  // Of readings that passed over a node.
  struct Debt {
    FieldShift own;    // of the node and its descendants
    FieldShift below;  // of its descendants besides, at most
  };
  // Covariance of the cells of a front, lower triangle; one per depth.
  struct Block {
    std::vector<double> values;
    std::size_t stride = 0;
  };
  // Of the present reading.
  struct Hearing {
    ReadingFactors factors;
    std::span<const PathStep> steps;  // those not yet visited; the next is the last
    FieldShift limit;
  };

  void CollectDebts();
  void PrefetchChildren(const SeparatorTree::Node& node,
                        void (BoundaryMemory::*prefetch)() const) const;
  FieldShift Visit(std::size_t node, std::size_t depth);
  void GatherBoundary(const Front& front, std::span<const std::uint32_t> places, const Block& from);
  void UpdateMean(const Front& front);
  void UpdateVariance(const Front& front);
  const double* FormCross(const Front& front);
  void FormBlock(const Front& front, Block& block);

  void VisitForReading(std::size_t node, const FieldShift& owed_above);
  double GatherColumn(const Front& front);
  void UpdateForReading(const Front& front);

  const SeparatorTree* tree_;
  std::vector<double> mean_ppm_;
  std::vector<double> variance_ppm2_;
  std::vector<BoundaryMemory> memories_;  // by node
  std::vector<FieldShift> below_;         // by node: error of its descendants beside its own
  std::vector<Debt> debts_;               // by node

  // Of the present pass.
  const FieldFactor* factor_ = nullptr;
  bool healthy_ = true;
  bool stopped_ = false;
  const StopFn* stop_ = nullptr;
  std::span<const std::uint8_t> dirty_;
  FieldShift tolerance_;
  std::vector<Block> blocks_;          // by depth
  std::vector<double> boundary_;       // Z_RR of the present node, full, stride |R|
  std::vector<double> boundary_mean_;  // m_R
  std::vector<double> cross_;          // Z_SR = W Z_RR
  std::vector<double> own_;
  std::vector<double> scratch_;  // of the weights of a leaf

  Hearing hearing_;
  std::vector<double> column_;  // x by slot, where it has been computed
  std::vector<double> x_;       // on the boundary of the present node
};

}  // namespace plumescout
