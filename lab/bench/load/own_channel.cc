// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/load/own_channel.h"

#include <grpcpp/grpcpp.h>

namespace plumescout::lab {

std::shared_ptr<grpc::Channel> OwnChannel(const std::string& target) {
  constexpr int kMaxReceive_bytes = 256 << 20;
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(kMaxReceive_bytes);
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(target, grpc::InsecureChannelCredentials(), arguments);
}

}  // namespace plumescout::lab
