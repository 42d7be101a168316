// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "absl/status/status.h"

namespace grpc {
class Channel;
class ChannelArguments;
}  // namespace grpc

namespace plumescout::client {

// How a client protects its connection and says who it is. Files are PEM and are read again when
// they change; an empty name: there is none.
struct Credentials {
  std::string tls_ca_file = {};  // authorities of the server's certificate; empty: plaintext
  std::string tls_certificate_file = {};  // the client's own, with its key
  std::string tls_key_file = {};
  std::string token_file = {};  // holds the bearer token on its first line
};

// kInvalidArgument, kNotFound saying which file is missing or does not fit.
absl::Status CheckCredentials(const Credentials& credentials);

// A channel whose calls carry the token. With credentials that CheckCredentials refuses, every call
// fails.
std::shared_ptr<grpc::Channel> MakeChannel(const std::string& target,
                                           const Credentials& credentials,
                                           const grpc::ChannelArguments& arguments);

}  // namespace plumescout::client
