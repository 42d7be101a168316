// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/gas/field/field_factor.h"
#include "core/gas/field/pending_reading.h"

namespace plumescout {

// How far means and covariances may be, or at most are, from the exact ones.
struct FieldShift {
  double mean_ppm = 0.0;
  double covariance_ppm2 = 0.0;
};

// Mean and marginal variance of every active cell, and the downward pass that keeps them so.
//
// Inside a subtree whose own fronts have not changed, the fields are averages of their values on
// its boundary, with weights >= 0 that sum to at most 1, plus something constant: if no mean and no
// covariance on the boundary has moved by more than d since the subtree was computed, nothing in it
// has. So each node remembers the boundary it was computed from, and how far its descendants may
// be off already; a subtree for which both together stay within the tolerance is left alone.
// Errors therefore do not add up, neither by depth nor in time.
class Marginals {
 public:
  explicit Marginals(const SeparatorTree& tree);

  // Brings the fields to `factor`, whose flagged fronts have changed. Cells that are not active
  // become NaN. Returns how far off the fields may be, at most `tolerance`.
  struct Pass {
    FieldShift error;
    bool healthy = true;  // all that was computed is finite, variances positive
  };
  Pass Descend(const FieldFactor& factor, std::span<const std::uint8_t> dirty,
               const FieldShift& tolerance);

  // One reading, exactly, in all cells. Returns whether they are healthy.
  bool Add(const PendingReading& reading);
  // Tells the remembered boundaries of readings that the fields have heard; to be called before
  // `factor` hears of them. Nodes with a flag are passed over. Cost: all boundaries squared.
  void Absorb(const FieldFactor& factor, const PendingReadings& readings,
              std::span<const std::uint8_t> dirty);

  const std::vector<double>& mean_ppm() const { return mean_ppm_; }  // by slot; deviation from m_0
  const std::vector<double>& variance_ppm2() const { return variance_ppm2_; }
  // The largest absolute mean of all active cells. Cost: O(cells).
  double LargestMean_ppm() const;

 private:
  friend struct FieldEnginePeer;  // of the tests

  // What a node was computed from.
  struct Origin {
    std::vector<double> mean_ppm;         // of the boundary
    std::vector<double> covariance_ppm2;  // of the boundary: lower triangle, packed by columns
    FieldShift below;                     // of its descendants, if it had not moved since
  };
  // Covariance of the cells of a front, lower triangle; one per depth.
  struct Block {
    std::vector<double> values;
    std::size_t stride = 0;
  };

  FieldShift Visit(std::size_t node, std::size_t depth);
  void GatherBoundary(const Front& front, const Front& parent, const Block& from);
  FieldShift Moved(const Front& front, const Origin& origin) const;
  void Remember(const Front& front, Origin& origin) const;
  void UpdateMean(const Front& front);
  void UpdateVariance(const Front& front);
  void FormCross(const Front& front);
  void FormBlock(const Front& front, Block& block);

  const SeparatorTree* tree_;
  std::vector<double> mean_ppm_;
  std::vector<double> variance_ppm2_;
  std::vector<Origin> origins_;  // by node

  // Of the present pass.
  const FieldFactor* factor_ = nullptr;
  std::span<const std::uint8_t> dirty_;
  FieldShift tolerance_;
  bool healthy_ = true;
  std::vector<Block> blocks_;     // by depth
  std::vector<double> boundary_;  // Z_RR of the present node, full, stride |R|
  std::vector<double> cross_;     // Z_SR = W Z_RR
  std::vector<double> diagonal_;
  std::vector<std::uint32_t> place_;  // of the boundary in the parent's block
};

}  // namespace plumescout
