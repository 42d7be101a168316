// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_map_watch.h"

#include "absl/time/clock.h"
#include "client/grpc_reader.h"
#include "core/types/status_macros.h"
#include "proto/convert/map_replica.h"

namespace plumescout::client {
namespace {

class GrpcMapWatch final : public MapWatch {
 public:
  GrpcMapWatch(MissionRoutes& routes, v1::MapService::Stub& stub,
               const v1::WatchMapRequest& request)
      : reader_(routes, stub, &v1::MapService::Stub::PrepareAsyncWatchMap, request) {}

  absl::StatusOr<MapChanges> Read(absl::Duration timeout) override {
    const absl::Time deadline = absl::Now() + timeout;
    do {
      PLUMESCOUT_ASSIGN_OR_RETURN(const v1::WatchMapResponse frame,
                                  ReadEndless(reader_, deadline - absl::Now()));
      const absl::Status taken = replica_.Apply(frame);
      if (!taken.ok()) {
        reader_.Cancel();
        return absl::InternalError(taken.message());
      }
    } while (!replica_.whole());
    return replica_.TakeChanges();
  }
  const MapSnapshot& map() const override { return replica_.map(); }
  void Cancel() override { reader_.Cancel(); }

 private:
  GrpcReader<v1::WatchMapResponse> reader_;
  MapReplica replica_;
};

}  // namespace

std::unique_ptr<MapWatch> OpenGrpcMapWatch(MissionRoutes& routes, v1::MapService::Stub& stub,
                                           const v1::WatchMapRequest& request) {
  return std::make_unique<GrpcMapWatch>(routes, stub, request);
}

}  // namespace plumescout::client
