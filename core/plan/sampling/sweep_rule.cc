// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <map>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/plan/sampling/sampling_rule.h"
#include "core/tour/lawnmower.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// Where the robot was first, as a corner of the lattice.
SweepCorner NearestCorner(const SamplingQuery& query) {
  const SiteLattice& lattice = query.sites.lattice;
  constexpr double kHalf = 0.5;
  const Point2 middle = {lattice.corner.x_m + kHalf * lattice.columns * lattice.spacing_m,
                         lattice.corner.y_m + kHalf * lattice.rows * lattice.spacing_m};
  const Point2 first = query.robot.robot.first_place.value_or(query.start);
  const bool right = first.x_m > middle.x_m;
  if (first.y_m > middle.y_m) {
    return right ? SweepCorner::kNorthEast : SweepCorner::kNorthWest;
  }
  return right ? SweepCorner::kSouthEast : SweepCorner::kSouthWest;
}

class SweepRule : public SamplingRule {
 public:
  absl::StatusOr<SamplingChoice> Choose(const SamplingQuery& query) const override {
    const SiteOptions& options = query.robot.options.sites;
    const SiteLattice& lattice = query.sites.lattice;
    std::map<std::size_t, const Site*> left;
    for (const Site& site : query.sites.offered) {
      if (!site.sampled) left[site.index] = &site;
    }
    PLUMESCOUT_ASSIGN_OR_RETURN(
        const std::vector<Cell> sweep,
        LawnmowerOrder({lattice.columns, lattice.rows, SweepAxis::kX, NearestCorner(query),
                        options.sweep_stride, options.sweep_leg_stride}));
    for (std::size_t i = 0; i < sweep.size(); ++i) {
      const auto site = left.find(static_cast<std::size_t>(sweep[i].y) *
                                      static_cast<std::size_t>(lattice.columns) +
                                  static_cast<std::size_t>(sweep[i].x));
      if (site == left.end()) continue;
      return SamplingChoice{MissionPhase::kSampling,
                            {{{*site->second}, 0.0}},
                            absl::StrFormat("site %d of %d of the sweep", i + 1, sweep.size())};
    }
    return SamplingChoice{};
  }
};

}  // namespace

std::unique_ptr<const SamplingRule> MakeSweepRule() { return std::make_unique<SweepRule>(); }

}  // namespace plumescout
