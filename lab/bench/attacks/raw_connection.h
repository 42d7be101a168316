// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace plumescout::lab {

// A TCP connection over which an attacker sends what it likes.
class RawConnection {
  struct Private {
    explicit Private() = default;
  };

 public:
  RawConnection(Private, int fd) : fd_(fd) {}
  // `target`: 127.0.0.1:port. From another address of this machine than honest callers have, so
  // that a front tells them apart.
  static absl::StatusOr<std::unique_ptr<RawConnection>> Open(const std::string& target);
  ~RawConnection();
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  // All of it; throws away what has come in meanwhile, so that the other side never has to wait.
  absl::Status Send(absl::string_view bytes);
  // What has come in by now.
  std::string Receive();

 private:
  const int fd_;
};

}  // namespace plumescout::lab
