// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/grpc_log.h"

#include <grpc/support/log.h>

#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "server/base/log.h"

namespace plumescout::server {
namespace {

LogLevel ToLevel(gpr_log_severity severity) {
  switch (severity) {
    case GPR_LOG_SEVERITY_DEBUG:
      return LogLevel::kDebug;
    case GPR_LOG_SEVERITY_INFO:
      return LogLevel::kInfo;
    case GPR_LOG_SEVERITY_ERROR:
      return LogLevel::kWarning;  // of a connection; the server is well
  }
  return LogLevel::kWarning;
}

void LogGrpc(gpr_log_func_args* said) {
  const absl::string_view file = said->file;
  Log(ToLevel(said->severity), "grpc",
      {{"why", said->message},
       {"where", absl::StrCat(file.substr(file.rfind('/') + 1), ":", said->line)}});
}

}  // namespace

void TakeGrpcLog() { gpr_set_log_function(LogGrpc); }

}  // namespace plumescout::server
