// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/support/server_callback.h>

#include <functional>
#include <memory>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/belief/belief.h"
#include "server/base/grpc_status.h"
#include "server/base/worker_pool.h"
#include "server/missions/mission_host.h"

namespace plumescout::server {

// Answers a unary call, now or later and from any thread, exactly once.
inline void Answer(grpc::ServerUnaryReactor* call, const absl::Status& status) {
  call->Finish(ToGrpc(status));
}

// Answers a call with what `read` makes of a belief. It runs on `pool`: neither the mission's
// writer nor a search waits for it. An error is for the caller to answer with.
inline absl::Status AnswerFromBelief(MissionHost& host, WorkerPool* pool,
                                     grpc::ServerUnaryReactor* call, BeliefRequest wanted,
                                     std::function<absl::Status(const Belief&)> read) {
  return host.AwaitBelief(
      std::move(wanted),
      [call, pool, read = std::move(read)](absl::StatusOr<std::shared_ptr<const Belief>> belief) {
        if (!belief.ok()) return Answer(call, belief.status());
        const absl::Status queued = pool->Submit(
            [call, read, belief = *std::move(belief)] { Answer(call, read(*belief)); });
        if (!queued.ok()) Answer(call, queued);
      });
}

}  // namespace plumescout::server
