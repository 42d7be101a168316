// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "core/gas/field/field_snapshot.h"
#include "core/gas/gas_inputs.h"
#include "core/gas/gas_lattice.h"
#include "core/types/cell_rect.h"
#include "core/types/grid.h"
#include "core/types/stop.h"

namespace plumescout {

// A reading that may be taken in a cell of the map.
struct ForeseenCell {
  Cell cell;
  double precision_per_ppm2 = 0.0;
};

// What readings would tell before they are taken, on the field of one moment. Shares the factor of
// the live field, which goes on without changing it. Immutable: may be read from any thread.
class GasWhatIf {
 public:
  // `prior_scale`: what variances are multiplied by, see PriorScale. `beside_ppm2`: what unknown
  // offsets of sensors and places within a coarse cell add to each variance, by lattice cell, if
  // anything. Further readings are taken not to change it, though they would make it less.
  GasWhatIf(FieldSnapshot field, const GasLattice& lattice, const GasInputs& inputs,
            double prior_scale = 1.0, std::vector<double> beside_ppm2 = {})
      : field_(std::move(field)),
        lattice_(lattice),
        states_(inputs.states()),
        factor_(inputs.factor()),
        prior_scale_(prior_scale),
        beside_ppm2_(std::move(beside_ppm2)) {}

  const Grid<CellState>& states() const { return states_.states(); }
  const GridGeometry& geometry() const { return states().geometry(); }

  // Marginal variance of every free cell if readings of `precision` (ppm^-2) each were taken in
  // `cells`, of geometry(), all at once; NaN off the free cells. Cells that are not free tell
  // nothing. Errors: kInvalidArgument for a cell off the map, a precision that is not positive or
  // not finite. Cost: O(k) passes over the factor for k cells, 1.5 ms for 16 at 160x200.
  absl::StatusOr<Grid<float>> VarianceIfRead(std::span<const Cell> cells, double precision) const;

  // For EntropyFall: the columns of such readings, none if no cell is free, and what the free cells
  // of geometry() weigh, all of which lie in `cells`, row by row; that is of no use once `stop`,
  // which is asked all along, says so. Both refer to this object. Columns take the memory of those
  // that are `used` no more. Errors: those of VarianceIfRead, and kCancelled once `stop` says so.
  absl::StatusOr<std::optional<InverseColumns>> ColumnsIfRead(
      std::span<const Cell> cells, double precision, const StopFn& stop = {},
      std::optional<InverseColumns> used = std::nullopt) const;
  EntropyFall FallOf(std::span<const float> weights, const CellRect& cells,
                     const StopFn& stop = {}) const;

  // Itself once these readings have been taken, whatever they say: others are then worth what
  // they tell beside them. For cells and errors see VarianceIfRead. Cost: that, and for each
  // node of the factor that lies on the way from a cell to the root a copy.
  // kCancelled once `stop`, which is asked all along, says so.
  absl::StatusOr<std::shared_ptr<const GasWhatIf>> Given(std::span<const ForeseenCell> readings,
                                                         const StopFn& stop = {}) const;

  // Marginal variance of every free cell now, ppm^2; NaN off those. Of no use once `stop`, which is
  // asked all along, says so. Cost: O(cells).
  Grid<float> variance_ppm2(const StopFn& stop = {}) const {
    return OnMap([this](std::size_t cell) { return field_.variance_ppm2(cell); }, stop);
  }

 private:
  GasWhatIf(const GasWhatIf& other, FieldSnapshot field)
      : field_(std::move(field)),
        lattice_(other.lattice_),
        states_(other.states_),
        factor_(other.factor_),
        prior_scale_(other.prior_scale_),
        beside_ppm2_(other.beside_ppm2_) {}

  // In the lattice; none of a cell that is not free. Errors: kInvalidArgument off the map.
  absl::StatusOr<std::optional<std::size_t>> FreeIndex(Cell cell) const;
  // Those of cells that are free.
  absl::StatusOr<std::vector<std::size_t>> FreeIndices(std::span<const Cell> cells) const;
  // Of variances that `variance_ppm2` tells by lattice cell.
  template <typename Variance>
  Grid<float> OnMap(const Variance& variance_ppm2, const StopFn& stop = {}) const {
    Grid<float> result(geometry(), std::numeric_limits<float>::quiet_NaN());
    const auto write = [&](std::size_t i, AnchorCell cell) {
      const std::size_t index = FieldIndex(cell);
      const double beside_ppm2 = beside_ppm2_.empty() ? 0.0 : beside_ppm2_[index];
      result[i] = static_cast<float>(prior_scale_ * (variance_ppm2(index) + beside_ppm2));
    };
    states_.ForEachFree(write, stop);
    return result;
  }
  // In the lattice, of a free cell.
  std::size_t FieldIndex(AnchorCell cell) const { return lattice_.Index(GasCellOf(cell, factor_)); }

  FieldSnapshot field_;
  GasLattice lattice_;
  AnchoredStates states_;
  int factor_;
  double prior_scale_;
  std::vector<double> beside_ppm2_;
};

}  // namespace plumescout
