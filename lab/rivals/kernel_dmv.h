// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lab/rivals/gas_mapper.h"

namespace plumescout::lab {

struct KernelDmvOptions {
  double kernel_width_m = 1.0;  // sigma: readings as far away as this still count, (0, 1000]
  // sigma_Omega: the weight at which a cell trusts its readings to 1 - 1/e. In units of the weight
  // that one reading has in its own place, N(0, sigma); (0, 1e6].
  double confidence_scale = 1.0;
};

// kInvalidArgument naming field, value and range.
absl::Status Validate(const KernelDmvOptions& options);

// Kernel DM+V (Lilienthal, Reggente, Trincavelli, Blanco and Gonzalez, A statistical approach to
// gas distribution modelling with mobile robots, IROS 2009), which [IPP] section I-A and [LHR]
// section I name beside the Markov random field. With the weight w_i(x) = N(|x_i - x|, sigma) of a
// reading z_i in the cell centred at x, cut off at 4 sigma,
//
//   Omega = sum w_i                    alpha = 1 - exp(-Omega^2 / sigma_Omega^2)
//   mean = alpha (sum w_i z_i) / Omega + (1 - alpha) r_0
//   variance = alpha (sum w_i (z_i - r_i)^2) / Omega + (1 - alpha) v_tot
//
// r_0 is the mean of all readings, r_i the mean map in the cell nearest to reading i, and v_tot the
// mean of all (z_i - r_i)^2. It knows no walls: gas in one room is felt in the next, which is why
// it is a peer here and not the map. Variances that readings bring along are not looked at: its
// variance is that of the gas, not of the estimate.
class KernelDmv final : public GasMapper {
 public:
  // REQUIRES: Validate(options).ok().
  explicit KernelDmv(const KernelDmvOptions& options) : options_(options) {}

  absl::Status Add(Point2 position, const GasReading& reading) override;
  // Errors: kFailedPrecondition without readings, of which there is no mean to fall back to.
  // Cost: O(readings * cells within 4 sigma).
  absl::StatusOr<MappedGas> MapOver(const Grid<CellState>& states) override;

 private:
  struct Reading {
    Point2 position;
    double concentration_ppm;
  };

  KernelDmvOptions options_;
  std::vector<Reading> readings_;
};

}  // namespace plumescout::lab
