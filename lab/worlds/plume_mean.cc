// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/plume_mean.h"

#include <cmath>
#include <ctime>
#include <numeric>

#include "lab/sim/concentration_slice.h"
#include "lab/sim/plume.h"

namespace plumescout::lab {
namespace {

constexpr double kSlicePeriod_s = 0.5;

int StepsIn(double duration_s) {
  return static_cast<int>(std::lround(duration_s / Plume::kStep_s));
}

double ProcessorTime_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

MassPoint MassOf(const Plume& plume) {
  constexpr std::int64_t kNone = 0;
  return {plume.time_s(), std::accumulate(plume.released().begin(), plume.released().end(), kNone),
          static_cast<std::int64_t>(plume.filaments().size()),
          std::accumulate(plume.left().begin(), plume.left().end(), kNone)};
}

}  // namespace

PlumeMean MeanOfFilaments(const PlumeCase& gas_case, const MeanWindow& window, std::uint64_t seed,
                          const FractionFn& progress) {
  const Grid<CellState>& occupancy = gas_case.raster.occupancy;
  Plume plume(gas_case.raster, gas_case.wind, gas_case.sources, gas_case.gas, seed,
              -window.warm_up_s);
  SliceRenderer renderer(occupancy, gas_case.sources, gas_case.gas);
  std::vector<double> sum_ppm(occupancy.size());
  PlumeMean mean{Grid<float>(occupancy.geometry()), {MassOf(plume)}, 0.0};
  const double begin_s = ProcessorTime_s();
  const double all_s = window.warm_up_s + window.mean_s;
  int slices = 0;
  while (plume.time_s() < window.mean_s - Plume::kStep_s / 2.0) {
    for (int step = 0; step < StepsIn(kSlicePeriod_s); ++step) plume.Step();
    mean.mass.push_back(MassOf(plume));
    if (progress) progress((plume.time_s() + window.warm_up_s) / all_s);
    if (plume.time_s() < Plume::kStep_s / 2.0) continue;
    ++slices;
    for (const Grid<float>& layer : renderer.Render(plume.filaments())) {
      for (std::size_t i = 0; i < sum_ppm.size(); ++i) sum_ppm[i] += layer[i];
    }
  }
  for (std::size_t i = 0; i < sum_ppm.size(); ++i) {
    mean.ppm[i] = static_cast<float>(sum_ppm[i] / slices);
  }
  mean.times_real_time = all_s / (ProcessorTime_s() - begin_s);
  return mean;
}

}  // namespace plumescout::lab
