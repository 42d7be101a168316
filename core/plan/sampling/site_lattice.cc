// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/sampling/site_lattice.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// How many squares an edge of the region has.
absl::StatusOr<int> Squares(const char* edge, double length_m, double spacing_m) {
  constexpr double kRounding = 1e-6;
  const double squares = length_m / spacing_m;
  const double whole = std::round(squares);
  if (whole >= 1.0 && whole <= kMaxSites && std::abs(squares - whole) <= kRounding) {
    return static_cast<int>(whole);
  }
  return absl::InvalidArgumentError(
      absl::StrCat("planning.sites.region = ", length_m, " m ", edge,
                   " must be a whole multiple of planning.sites.spacing_m = ", spacing_m,
                   ", from 1 to ", kMaxSites, " times"));
}

}  // namespace

absl::StatusOr<SiteLattice> MakeSiteLattice(const Rectangle& region, double spacing_m) {
  SiteLattice lattice{region.min, spacing_m, 0, 0};
  PLUMESCOUT_ASSIGN_OR_RETURN(lattice.columns, Squares("wide", region.width_m(), spacing_m));
  PLUMESCOUT_ASSIGN_OR_RETURN(lattice.rows, Squares("high", region.height_m(), spacing_m));
  if (static_cast<double>(lattice.size()) <= kMaxSites) return lattice;
  return absl::InvalidArgumentError(absl::StrCat("planning.sites.region = ", lattice.columns, " x ",
                                                 lattice.rows, " sites must be at most ",
                                                 kMaxSites));
}

SiteLattice CoveringLattice(const GridGeometry& map, double spacing_m) {
  const auto first = [&](double low_m) { return std::floor(low_m / spacing_m); };
  const auto count = [&](double low_m, int cells) {
    const double high_m = low_m + cells * map.resolution_m;
    return static_cast<int>(std::ceil(high_m / spacing_m) - first(low_m));
  };
  return {{first(map.origin_x_m) * spacing_m, first(map.origin_y_m) * spacing_m},
          spacing_m,
          count(map.origin_x_m, map.width),
          count(map.origin_y_m, map.height)};
}

SiteLattice LatticeOver(const GridGeometry& map, const SiteOptions& options) {
  if (options.region) {
    const auto lattice = MakeSiteLattice(*options.region, options.spacing_m);
    if (lattice.ok()) return *lattice;
  }
  return CoveringLattice(map, options.spacing_m);
}

Rectangle RegionOver(const GridGeometry& building, double spacing_m, int stride) {
  const auto span = [&](double low_m, int cells, double& first_m, double& last_m) {
    first_m = std::floor(low_m / spacing_m) * spacing_m;
    const double covering =
        std::ceil((low_m + cells * building.resolution_m - first_m) / spacing_m);
    const double legs = std::ceil((covering - 1.0) / stride);
    last_m = first_m + (legs * stride + 1.0) * spacing_m;
  };
  Rectangle region;
  span(building.origin_x_m, building.width, region.min.x_m, region.max.x_m);
  span(building.origin_y_m, building.height, region.min.y_m, region.max.y_m);
  return region;
}

}  // namespace plumescout
