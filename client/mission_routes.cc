// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/mission_routes.h"

#include <algorithm>

#include "absl/status/status.h"
#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/string_view.h"
#include "absl/strings/strip.h"
#include "client/grpc_status.h"
#include "core/types/error_reason.h"
#include "proto/convert/status.h"

namespace plumescout::client {
namespace {

constexpr char kMissionKey[] = "x-mission-id";
constexpr char kNodeKey[] = "x-node";
constexpr char kOwnerKey[] = "x-owner";
constexpr std::size_t kMaxValueLength = 128;

// What gRPC takes for metadata, and a front for a header. (It aborts the program for others.)
bool IsWord(absl::string_view text) {
  return !text.empty() && text.size() <= kMaxValueLength &&
         std::all_of(text.begin(), text.end(),
                     [](char c) { return absl::ascii_isgraph(static_cast<unsigned char>(c)); });
}

std::string OwnerOf(const grpc::ClientContext& context) {
  const auto& trailers = context.GetServerTrailingMetadata();
  const auto found = trailers.find(kOwnerKey);
  if (found == trailers.end()) return {};
  std::string owner(found->second.data(), found->second.size());
  return IsWord(owner) ? owner : std::string();
}

// Whether the server has gone, or goes, or hangs, or a front could not reach it.
bool IsGone(const absl::Status& status) {
  const std::string why = Reason(status);
  switch (status.code()) {
    case absl::StatusCode::kUnavailable:
      return why.empty() || why == reason::kDraining || why == reason::kFenced ||
             why == reason::kStoreUnavailable;
    case absl::StatusCode::kUnknown:
    case absl::StatusCode::kInternal:
    case absl::StatusCode::kDeadlineExceeded:
      return why.empty();
    default:
      return false;
  }
}

}  // namespace

std::string MissionRoutes::Address(const std::string& mission, grpc::ClientContext& context) const {
  if (!IsWord(mission)) return {};
  context.AddMetadata(kMissionKey, mission);
  absl::MutexLock lock(&mutex_);
  const auto found = nodes_.find(mission);
  if (found == nodes_.end()) return {};
  context.AddMetadata(kNodeKey, found->second);
  return found->second;
}

bool MissionRoutes::Note(const std::string& mission, const std::string& node,
                         const grpc::Status& grpc_status, const grpc::ClientContext& context) {
  if (mission.empty() || grpc_status.ok()) return false;
  const absl::Status status = FromGrpc(grpc_status);
  if (IsGone(status)) Forget(mission, node);
  if (Reason(status) == reason::kMissionElsewhere) {
    const std::string owner = OwnerOf(context);
    if (owner.empty() || owner == node) return false;  // it was asked, and is not there
    absl::MutexLock lock(&mutex_);
    if (nodes_.size() >= kMaxMissions && !nodes_.contains(mission)) nodes_.clear();
    nodes_[mission] = owner;
    return true;
  }
  return false;
}

void MissionRoutes::Forget(const std::string& mission, const std::string& node) {
  absl::MutexLock lock(&mutex_);
  const auto known = nodes_.find(mission);
  if (known != nodes_.end() && known->second == node) nodes_.erase(known);
}

std::string MissionOf(const google::protobuf::Message& request) {
  using google::protobuf::FieldDescriptor;
  const auto* reflection = request.GetReflection();
  for (const char* name : {"mission", "name", "robot", "mission_id", "open"}) {
    const FieldDescriptor* field = request.GetDescriptor()->FindFieldByName(name);
    if (field == nullptr || field->is_repeated()) continue;
    std::string mission;
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
      mission = reflection->GetString(request, field);
    } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      mission = MissionOf(reflection->GetMessage(request, field));
    }
    if (mission.empty()) continue;
    const absl::string_view rest = absl::StripPrefix(mission, "missions/");
    return std::string(rest.substr(0, rest.find('/')));
  }
  return {};
}

}  // namespace plumescout::client
