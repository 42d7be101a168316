// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/client_context.h>
#include <grpcpp/support/status.h>

#include <cstddef>
#include <map>
#include <string>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"

namespace plumescout::client {

// Which of several servers has a mission, as far as they have told. Thread-safe.
class MissionRoutes {
 public:
  // A call that is sent to another server so often is left to whoever waits between attempts.
  static constexpr int kMaxRedirects = 3;

  // Says in the call's metadata what a front finds a server by: the mission, and the server known
  // to have it. Returns the latter, or nothing.
  std::string Address(const std::string& mission, grpc::ClientContext& context) const;
  // Learns from how a call ended, which was addressed to `node`; true if another server has the
  // mission, and the call may be made again at once.
  bool Note(const std::string& mission, const std::string& node, const grpc::Status& status,
            const grpc::ClientContext& context);

  // That `node` has the mission, for it does not answer.
  void Forget(const std::string& mission, const std::string& node);

 private:
  static constexpr std::size_t kMaxMissions = 4096;  // beyond them all is forgotten: it is a hint

  mutable absl::Mutex mutex_;
  std::map<std::string, std::string> nodes_ ABSL_GUARDED_BY(mutex_);  // by mission
};

// The ID of the mission that a request of this service is about, as it is named in it; nothing of
// one that is about none.
std::string MissionOf(const google::protobuf::Message& request);

}  // namespace plumescout::client
