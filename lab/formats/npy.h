// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace plumescout::lab {

// Array of a NumPy .npy file. Row-major: the last index runs fastest. A scalar has no dimensions.
struct NpyArray {
  std::vector<std::size_t> shape;
  std::vector<float> values;  // as many as the product of `shape`
};

// Reads .npy version 1.0 or 2.0, C order, little-endian float32 or float64 (rounded to float32).
//
// Errors, each naming the file: kNotFound; kDataLoss if it is truncated, has bytes left over or
// its header does not parse; kInvalidArgument for another type, Fortran order, more than 8
// dimensions, more than 2^28 values, or a finite float64 that float32 cannot hold.
absl::StatusOr<NpyArray> ReadNpy(const std::string& path);

// Writes float32, version 1.0, C order. kInvalidArgument if `values` does not fill `shape`.
absl::Status WriteNpy(const std::string& path, std::span<const std::size_t> shape,
                      std::span<const float> values);

}  // namespace plumescout::lab
