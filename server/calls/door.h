// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/server_context.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "proto/convert/names.h"
#include "server/access/principal.h"
#include "server/access/rpc.h"
#include "server/base/clock.h"
#include "server/base/stage_times.h"
#include "server/calls/call_rates.h"
#include "server/store/store_nodes.h"

namespace plumescout::server {

// A call that was let in.
struct CallInfo {
  Rpc rpc = Rpc::kGetServerInfo;
  Principal caller;
  // Whose share of the server it takes: the caller's, or, of those that nobody knows, that of the
  // machine they call from.
  std::string account;
  std::string unreached_node;  // that the call named, as the router says; empty: none
  std::string request_id;  // of log lines and error details: the caller's x-request-id, or made up
  SteadyTime began;
  SteadyTime deadline = SteadyTime::max();  // the caller's; no earlier than `began`
  std::shared_ptr<StageTimes> stage_times = std::make_shared<StageTimes>();
  std::function<absl::Status()> recheck;  // as Identity
};

// A call that is over.
struct CallEnd {
  absl::Status status;
  absl::Duration duration;
};

// Who calls.
struct Identity {
  Principal caller;
  // Whether that still holds: kUnauthenticated once a token is revoked, or has expired. From any
  // thread, while the call lasts and after it. Null: it holds for ever.
  std::function<absl::Status()> recheck = nullptr;
};

// Says who calls; kUnauthenticated if that cannot be told.
using Authenticate = std::function<absl::StatusOr<Identity>(const grpc::CallbackServerContext&)>;
// Hears of every call, also of those that were not let in. Must not block.
using CallObserver = std::function<void(const CallInfo&, const CallEnd&)>;
using OnStray = std::function<void(const OwnedMission&)>;

// The one door: every unary and stream handler passes it, in and out. Thread-safe.
class Door {
 public:
  // `authenticate` null: everybody is an anonymous admin.
  explicit Door(Authenticate authenticate = nullptr, const CallRateOptions& rates = {})
      : authenticate_(std::move(authenticate)), rates_(std::make_unique<CallRates>(rates)) {}
  // REQUIRES: no call has entered.
  void AddObserver(CallObserver observer) { observers_.push_back(std::move(observer)); }
  // Hears of calls whose mission is at a node that the router does not reach. Must not block.
  // REQUIRES: no call has entered.
  void SetOnStray(OnStray on_stray) { on_stray_ = std::move(on_stray); }

  // kUnauthenticated, kPermissionDenied, RATE_EXCEEDED. Whoever is let in leaves once. `info` is
  // filled in anyway.
  absl::Status Enter(Rpc rpc, const grpc::CallbackServerContext& call, CallInfo& info) const;
  void Leave(const CallInfo& info, const absl::Status& status) const;
  // What a call is told whose mission is elsewhere: NODE_UNREACHED, if that is info.unreached_node.
  absl::Status Redirect(const CallInfo& info, const absl::Status& elsewhere) const;

 private:
  const Authenticate authenticate_;
  OnStray on_stray_;  // null: nobody wants to know
  const std::unique_ptr<CallRates> rates_;
  std::vector<CallObserver> observers_;
};

// One call's passage through the door: in, and out again once. Thread-compatible.
class Visit {
 public:
  // As Door::Enter. The door outlives the visit.
  absl::Status Enter(const Door& door, Rpc rpc, grpc::CallbackServerContext& call);
  // What the call is to be told: what it ended with, or NODE_UNREACHED if its mission is at the
  // node that it named and the router does not reach. It is told that name (trailer x-owner).
  // Nothing is done for who was not let in, or has left.
  absl::Status Leave(absl::Status status);

  // Of who was not let in, too.
  const CallInfo& info() const { return info_; }
  const Principal& caller() const { return info_.caller; }

 private:
  const Door* door_ = nullptr;  // null: not inside
  grpc::CallbackServerContext* call_ = nullptr;
  CallInfo info_;
};

// kPermissionDenied unless the caller may act for this robot.
absl::Status CheckActsFor(const Principal& caller, const RobotName& robot);

}  // namespace plumescout::server
