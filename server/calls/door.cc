// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/door.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "core/types/error_reason.h"
#include "server/base/errors.h"
#include "server/missions/recovery_list.h"
#include "server/store/store_errors.h"

namespace plumescout::server {
namespace {

constexpr char kRequestIdKey[] = "x-request-id";
constexpr std::size_t kMaxWordLength = 64;
constexpr char kOwnerKey[] = "x-owner";
constexpr char kUnreachedKey[] = "x-unreached";  // by the router alone, deploy/cluster/haproxy.cfg

std::string NewRequestId() {
  thread_local std::mt19937_64 bits{std::random_device{}()};
  return absl::StrCat(absl::Hex(bits(), absl::kZeroPad16));
}

bool IsWord(const grpc::string_ref& text) {
  return !text.empty() && text.size() <= kMaxWordLength &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return absl::ascii_isgraph(static_cast<unsigned char>(c)); });
}

// The word that a call says under this key; empty if it says none.
std::string WordOf(const grpc::CallbackServerContext& call, const char* key) {
  const auto& metadata = call.client_metadata();
  const auto found = metadata.find(key);
  if (found == metadata.end() || !IsWord(found->second)) return {};
  return {found->second.data(), found->second.size()};
}

// Without the port.
std::string MachineOf(const std::string& peer) { return peer.substr(0, peer.rfind(':')); }

// No tenant and no name has a space, and what gRPC says of peers begins otherwise.
std::string AccountOf(const Principal& caller, const std::string& peer) {
  if (caller == Principal{}) return MachineOf(peer);
  return absl::StrCat("caller ", caller.tenant, " ", caller.name);
}

}  // namespace

absl::Status Door::Enter(Rpc rpc, const grpc::CallbackServerContext& call, CallInfo& info) const {
  info.rpc = rpc;
  info.unreached_node = WordOf(call, kUnreachedKey);
  info.request_id = WordOf(call, kRequestIdKey);
  if (info.request_id.empty()) info.request_id = NewRequestId();
  info.began = SteadyNow();
  info.deadline = std::max(info.began, ToSteady(call.deadline()));
  absl::Status status;
  if (authenticate_) {
    auto identity = authenticate_(call);
    status = identity.status();
    if (identity.ok()) {
      info.caller = std::move(identity->caller);
      info.recheck = std::move(identity->recheck);
    }
  }
  info.account = AccountOf(info.caller, call.peer());
  if (status.ok() && !IsAllowed(info.caller.role, rpc)) {
    status = absl::PermissionDeniedError(
        absl::StrCat(info.caller.name, " may not call ", RowOf(rpc).method));
  }
  if (status.ok()) status = rates_->Admit(info.account, rpc);
  if (!status.ok()) Leave(info, status);
  return status;
}

void Door::Leave(const CallInfo& info, const absl::Status& status) const {
  const CallEnd end{status, absl::FromChrono(SteadyNow() - info.began)};
  for (const CallObserver& observer : observers_) observer(info, end);
}

absl::Status Visit::Enter(const Door& door, Rpc rpc, grpc::CallbackServerContext& call) {
  const absl::Status status = door.Enter(rpc, call, info_);
  if (status.ok()) door_ = &door;
  call_ = &call;
  return status;
}

absl::Status Door::Redirect(const CallInfo& info, const absl::Status& elsewhere) const {
  const absl::string_view owner = NodeElsewhere(elsewhere);
  if (owner.empty() || owner != info.unreached_node) return elsewhere;
  const OwnedMission mission{KeyElsewhere(elsewhere), std::string(owner)};
  if (on_stray_) on_stray_(mission);
  return NodeUnreached(MissionIdOf(mission.key), owner);
}

absl::Status Visit::Leave(absl::Status status) {
  if (door_ == nullptr) return status;
  const absl::string_view owner = NodeElsewhere(status);
  if (!owner.empty()) call_->AddTrailingMetadata(kOwnerKey, std::string(owner));
  status = door_->Redirect(info_, status);
  std::exchange(door_, nullptr)->Leave(info_, status);
  return status;
}

absl::Status CheckActsFor(const Principal& caller, const RobotName& robot) {
  if (!caller.own_robot_only || caller.name == robot.robot) return absl::OkStatus();
  return absl::PermissionDeniedError(
      absl::StrCat(caller.name, " may not act for robot ", robot.robot));
}

}  // namespace plumescout::server
