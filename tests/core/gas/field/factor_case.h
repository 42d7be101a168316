// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/gas/field/field_factor.h"
#include "tests/core/gas/field/field_case.h"

namespace plumescout::testing {

// A random map, eliminated, with its dense inverse.
struct FactorCase {
  explicit FactorCase(std::uint64_t seed) : rng(seed), field(RandomFieldCase(21, 18, 0.25, rng)) {
    std::vector<std::uint8_t> active;
    for (const CellInput& cell : field.cells) active.push_back(cell.active ? 1 : 0);
    tree = std::make_shared<SeparatorTree>(field.width, field.height(), active);
    cells = FieldCells(*tree, field.cells);
    factor = FieldFactor(tree);
    FrontBuilder builder(*tree, DefaultField().prior);
    factor.Eliminate(std::vector<std::uint8_t>(tree->nodes().size(), 1), cells, builder);
    dense = std::make_unique<DenseTruth>(field.Dense());
    inverse = dense->covariance();
    mean_ppm = dense->mean_ppm();
  }

  bool IsActive(Slot slot) const { return cells.active[slot] != 0; }
  // Row of the dense system.
  Eigen::Index Variable(Slot slot) const { return dense->variable(tree->cell(slot)); }
  // Different ones.
  std::vector<Slot> RandomActiveSlots(std::size_t count) const {
    Rng draw(count);
    std::vector<Slot> slots;
    while (slots.size() < count) {
      const auto slot = static_cast<Slot>(draw.Below(tree->cells()));
      if (!IsActive(slot) || std::count(slots.begin(), slots.end(), slot) > 0) continue;
      slots.push_back(slot);
    }
    return slots;
  }

  Rng rng;
  FieldCase field;
  std::shared_ptr<const SeparatorTree> tree;
  FieldCells cells;
  FieldFactor factor{std::make_shared<SeparatorTree>(1, 1, std::vector<std::uint8_t>{0})};
  std::unique_ptr<DenseTruth> dense;
  Eigen::MatrixXd inverse;
  Eigen::VectorXd mean_ppm;
};

}  // namespace plumescout::testing
