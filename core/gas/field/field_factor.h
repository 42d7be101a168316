// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/gas/field/front_builder.h"
#include "core/gas/field/reading_paths.h"
#include "core/gas/field/separator_tree.h"
#include "core/types/stop.h"

namespace plumescout {

// A separator tree with all its nodes eliminated: H^-1 in factored form. A copy shares the fronts,
// which never change; it costs one pointer per node.
class FieldFactor {
 public:
  explicit FieldFactor(std::shared_ptr<const SeparatorTree> tree)
      : tree_(std::move(tree)), fronts_(tree_->nodes().size()) {}

  const SeparatorTree& tree() const { return *tree_; }
  const Front& front(std::size_t node) const { return *fronts_[node]; }
  // Which cells of its parent's front the boundary cells of a node are, that is not the root.
  std::span<const std::uint32_t> PlacesInParent(std::size_t node) const {
    const SeparatorTree::Node& parent = tree_->nodes()[tree_->nodes()[node].parent];
    const std::span<const std::uint32_t> places = front(tree_->nodes()[node].parent).child_places;
    const std::size_t size = front(node).boundary();
    return parent.children[0] == node ? places.first(size) : places.last(size);
  }

  // Eliminates the nodes anew whose flag is set. REQUIRES: ancestors of a flagged node are flagged;
  // at the first call all are. Returns false if `stop`, which is asked at every node, said so: then
  // this is no factor any more.
  bool Eliminate(std::span<const std::uint8_t> dirty, const FieldCells& cells,
                 FrontBuilder& builder, const StopFn& stop = {});

  // What each node from the owner of an active cell to the root knows of it; at the root that is
  // its mean and variance. Cost: that of reading the fronts.
  std::vector<PathStep> StepsFrom(Slot slot) const;
  // The cell that the steps start from has more evidence. Its nodes are to be eliminated anew when
  // next any is. Cost: that of copying the fronts.
  void AddReading(std::span<const PathStep> steps, double precision, double weighted_deviation);
  // The cells of `paths` have been read, each with noise of that variance (1 / precision), whatever
  // was heard: only variances are right from then on. Of no use once `stop`, which is asked all
  // along, says so. Cost: that of copying the fronts once.
  void AddForeseen(const ReadingPaths& paths, std::span<const double> noise_ppm2,
                   const StopFn& stop = {});

  // Multiply-adds of eliminating all nodes. Cost: O(nodes).
  double work() const;

 private:
  friend struct FieldEnginePeer;  // of the tests

  std::shared_ptr<const SeparatorTree> tree_;
  std::vector<std::shared_ptr<const Front>> fronts_;  // by node
};

}  // namespace plumescout
