// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/gaden_wind.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"
#include "formats/little_endian.h"

namespace plumescout::lab {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 32;
constexpr std::size_t kComponents = 3;
constexpr std::size_t kHeaderBytes3 = 2 * sizeof(std::int32_t);

}  // namespace

GridGeometry SliceGeometry(const GadenEnvironment& environment) {
  return {environment.min[0], environment.min[1], environment.cell_size_m, environment.cells[0],
          environment.cells[1]};
}

absl::StatusOr<WindField> ReadGadenWind(const std::string& path,
                                        const GadenEnvironment& environment, int z) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path, kMaxBytes));
  const std::size_t cells = environment.size();
  const std::size_t size3 = kHeaderBytes3 + kComponents * sizeof(float) * cells;
  const std::size_t size2 = kComponents * sizeof(double) * cells;
  if (bytes.size() != size3 && bytes.size() != size2) {
    return absl::DataLossError(absl::StrCat(path, ": ", bytes.size(), " bytes, for ", cells,
                                            " cells it must be ", size3, " or ", size2));
  }
  const auto component = [&](std::size_t cell, std::size_t axis) -> double {
    if (bytes.size() == size2) {
      return LoadLittleEndian<double>(bytes.data() + sizeof(double) * (axis * cells + cell));
    }
    return LoadLittleEndian<float>(bytes.data() + kHeaderBytes3 +
                                   sizeof(float) * (kComponents * cell + axis));
  };
  const GridGeometry geometry = SliceGeometry(environment);
  WindField wind{Grid<float>(geometry), Grid<float>(geometry)};
  for (int y = 0; y < geometry.height; ++y) {
    for (int x = 0; x < geometry.width; ++x) {
      const std::size_t cell = environment.Index(x, y, z);
      const double u_mps = component(cell, 0);
      const double v_mps = component(cell, 1);
      if (!std::isfinite(u_mps) || !std::isfinite(v_mps)) {
        return absl::InvalidArgumentError(absl::StrCat(path, ": the wind in cell (", x, ", ", y,
                                                       ", ", z, ") is ", u_mps, ", ", v_mps));
      }
      wind.u_mps[Cell{x, y}] = static_cast<float>(u_mps);
      wind.v_mps[Cell{x, y}] = static_cast<float>(v_mps);
    }
  }
  return wind;
}

}  // namespace plumescout::lab
