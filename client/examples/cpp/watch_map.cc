// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// watch_map HOST:PORT MISSION [COUNT]: says at each change of a mission's map how much of it is
// free, and where the most gas is; after COUNT changes it ends.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include "client/grpc_viewer_client.h"

namespace {

namespace client = plumescout::client;

void Describe(const plumescout::MapSnapshot& map, const plumescout::MapChanges& changes) {
  const plumescout::GridGeometry& geometry = map.occupancy.geometry();
  std::size_t free_cells = 0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < map.occupancy.size(); ++i) {
    if (map.occupancy[i] == plumescout::CellState::kFree) ++free_cells;
    // NaN, where no gas is known, is not greater than anything.
    if (map.gas_mean_ppm[i] > map.gas_mean_ppm[worst] || std::isnan(map.gas_mean_ppm[worst])) {
      worst = i;
    }
  }
  std::printf("revision %lld: %s, %.1f m2 free", static_cast<long long>(map.revision),
              changes.everything ? "all new" : "changed",
              static_cast<double>(free_cells) * geometry.resolution_m * geometry.resolution_m);
  if (map.occupancy.size() > 0 && !std::isnan(map.gas_mean_ppm[worst])) {
    const plumescout::Point2 place = geometry.Center(geometry.CellAtIndex(worst));
    std::printf(", %.1f ppm at (%.1f, %.1f)", static_cast<double>(map.gas_mean_ppm[worst]),
                place.x_m, place.y_m);
  }
  std::printf("\n");
}

absl::Status Watch(client::ViewerClient& viewer, const plumescout::MissionId& mission, int count) {
  const auto watch = viewer.WatchMap(mission, {});
  if (!watch.ok()) return watch.status();
  for (int seen = 0; count == 0 || seen < count; ++seen) {
    const auto changes = (*watch)->Read(absl::InfiniteDuration());
    if (!changes.ok()) return changes.status();
    Describe((*watch)->map(), *changes);
  }
  return absl::OkStatus();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: watch_map HOST:PORT MISSION [COUNT]\n");
    return EXIT_FAILURE;
  }
  const auto viewer = client::MakeGrpcViewerClient({.target = argv[1]});
  const absl::Status status = Watch(*viewer, argv[2], argc > 3 ? std::atoi(argv[3]) : 0);
  if (!status.ok()) std::fprintf(stderr, "watch_map: %s\n", status.ToString().c_str());
  return status.ok() ? EXIT_SUCCESS : EXIT_FAILURE;
}
