// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

namespace grpc {
class Channel;
}

namespace plumescout::lab {

// Over a connection that nobody else uses; takes messages as large as any map.
std::shared_ptr<grpc::Channel> OwnChannel(const std::string& target);

}  // namespace plumescout::lab
