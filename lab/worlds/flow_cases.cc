// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/flow_cases.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/types/status_macros.h"
#include "lab/sim/flow_solver.h"

namespace plumescout::lab {
namespace {

constexpr double kStepShare = 0.9;   // of the solver's stable step
constexpr double kCheckEvery = 1.0;  // time between looks at whether the flow is steady
constexpr double kDeveloped = 0.99;  // of the final speed on the centre line
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

GridGeometry Raster(int width, int height, double cell) {
  GridGeometry geometry;
  geometry.resolution_m = cell;
  geometry.width = width;
  geometry.height = height;
  return geometry;
}

int Cells(double length, double cell) { return static_cast<int>(std::lround(length / cell)); }

void OpenEast(FlowDomain& domain) {
  const int last = domain.fluid.width() - 1;
  for (int y = 0; y < domain.fluid.height(); ++y) {
    domain.openings.push_back({{last, y}, Side::kEast, std::nullopt});
  }
}

double LargestChange(const MacField& now, MacField& before) {
  before.AddScaled(now, -1.0);
  const Velocity largest = before.MaxMagnitudes();
  before = now;
  return std::max(largest.u_mps, largest.v_mps);
}

}  // namespace

FlowDomain CavityDomain(int cells) {
  FlowDomain domain;
  domain.fluid = Grid<std::uint8_t>(Raster(cells, cells, 1.0 / cells), 1);
  domain.edge_speeds_mps[static_cast<std::size_t>(Side::kNorth)] = 1.0;
  return domain;
}

FlowDomain ChannelDomain(int cells_across, double length) {
  FlowDomain domain;
  const double cell = 1.0 / cells_across;
  domain.fluid = Grid<std::uint8_t>(Raster(Cells(length, cell), cells_across, cell), 1);
  for (int y = 0; y < cells_across; ++y) domain.openings.push_back({{0, y}, Side::kWest, 1.0});
  OpenEast(domain);
  return domain;
}

FlowDomain StepDomain(int cells_per_step, double length_behind) {
  FlowDomain domain;
  const int n = cells_per_step;
  const double cell = 1.0 / n;
  const int width = Cells(kStepUpstream + length_behind, cell);
  domain.fluid = Grid<std::uint8_t>(Raster(width, 2 * n, cell), 1);
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < Cells(kStepUpstream, cell); ++x) domain.fluid[Cell{x, y}] = 0;
  }
  double flow = 0.0;
  for (int y = n; y < 2 * n; ++y) {
    const double height = (y - n + 0.5) * cell;
    domain.openings.push_back({{0, y}, Side::kWest, height * (1.0 - height)});
    flow += cell * height * (1.0 - height);
  }
  for (BoundaryFace& inlet : domain.openings) inlet.inflow_mps = *inlet.inflow_mps / flow;
  OpenEast(domain);
  return domain;
}

absl::StatusOr<SteadyFlow> RunToSteady(const FlowDomain& domain, double viscosity,
                                       const SteadyLimits& limits) {
  PLUMESCOUT_ASSIGN_OR_RETURN(FlowSolver solver, FlowSolver::Create(domain, viscosity));
  MacField before = solver.velocity();
  double time = 0.0;
  double looked_at = 0.0;
  double change = std::numeric_limits<double>::infinity();
  while (time < limits.max_time && change > limits.change_per_time) {
    const double step = kStepShare * solver.StableStep_s();
    PLUMESCOUT_RETURN_IF_ERROR(solver.Step(step));
    time += step;
    if (time - looked_at < kCheckEvery) continue;
    change = LargestChange(solver.velocity(), before) / (time - looked_at);
    looked_at = time;
  }
  return SteadyFlow{solver.velocity(), change};
}

std::vector<LineSample> CavityU(const MacField& velocity) {
  const int n = velocity.geometry().width;
  std::vector<LineSample> samples = {{0.0, 0.0}};
  for (int y = 0; y < n; ++y) samples.push_back({(y + 0.5) / n, velocity.u(n / 2, y)});
  samples.push_back({1.0, 1.0});
  return samples;
}

std::vector<LineSample> CavityV(const MacField& velocity) {
  const int n = velocity.geometry().width;
  std::vector<LineSample> samples = {{0.0, 0.0}};
  for (int x = 0; x < n; ++x) samples.push_back({(x + 0.5) / n, velocity.v(x, n / 2)});
  samples.push_back({1.0, 0.0});
  return samples;
}

double Interpolate(const std::vector<LineSample>& samples, double at) {
  constexpr std::size_t kPoints = 4;
  const auto above = std::upper_bound(samples.begin(), samples.end(), at,
                                      [](double x, const LineSample& s) { return x < s.at; });
  const auto index = static_cast<std::size_t>(above - samples.begin());
  const std::size_t first = std::clamp<std::size_t>(index, 2, samples.size() - 2) - 2;
  double value = 0.0;  // Lagrange's form
  for (std::size_t i = first; i < first + kPoints; ++i) {
    double weight = 1.0;
    for (std::size_t j = first; j < first + kPoints; ++j) {
      if (j != i) weight *= (at - samples[j].at) / (samples[i].at - samples[j].at);
    }
    value += weight * samples[i].speed;
  }
  return value;
}

double Least(const std::vector<LineSample>& samples) {
  const auto least =
      std::min_element(samples.begin() + 2, samples.end() - 2,
                       [](const LineSample& a, const LineSample& b) { return a.speed < b.speed; });
  const double before = (least - 1)->speed;
  const double after = (least + 1)->speed;
  const double bend = before - 2.0 * least->speed + after;
  const double slope = 0.5 * (after - before);
  return bend > 0.0 ? least->speed - 0.5 * slope * slope / bend : least->speed;
}

double ReattachmentLength(const MacField& velocity) {
  const double cell = velocity.geometry().resolution_m;
  const int step = Cells(kStepUpstream, cell);
  double length = kNan;
  for (int x = step + 1; x < velocity.geometry().width; ++x) {
    const double here = velocity.u(x, 0);
    const double next = velocity.u(x + 1, 0);
    if (here < 0.0 && next >= 0.0) length = (x - step + here / (here - next)) * cell;
  }
  return length;
}

double EntranceLength(const MacField& velocity) {
  const GridGeometry& geometry = velocity.geometry();
  const int middle = geometry.height / 2;
  const double developed = kDeveloped * velocity.u(geometry.width, middle);
  int x = geometry.width;
  while (x > 0 && velocity.u(x - 1, middle) >= developed) --x;
  if (x == 0) return 0.0;
  const double before = velocity.u(x - 1, middle);
  const double share = (developed - before) / (velocity.u(x, middle) - before);
  return (x - 1 + share) * geometry.resolution_m;
}

}  // namespace plumescout::lab
