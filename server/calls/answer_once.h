// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "absl/status/status.h"
#include "google/protobuf/message.h"
#include "server/base/request_memory.h"
#include "server/calls/unary_call.h"

namespace plumescout::server {

// How `memory` knows a call.
RequestKey KeyOf(const UnaryCall& call, const std::string& request_id);

// Has a call answered by `handle`, unless an equal one of the same caller has the same request id:
// then with the answer of that, once it is there. An empty id names nothing. Errors are for the
// caller to answer with, as those of UnaryCall::Handler. `handle` may be called later, and touches
// nothing that does not live until the answer.
absl::Status AnswerOnce(const std::shared_ptr<RequestMemory>& memory, const std::string& request_id,
                        const google::protobuf::Message& request,
                        google::protobuf::Message* response, const std::shared_ptr<UnaryCall>& call,
                        const UnaryCall::Handler& handle);

}  // namespace plumescout::server
