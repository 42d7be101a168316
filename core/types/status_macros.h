// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

// Returns from the enclosing function if `expr` (a Status) is an error.
#define PLUMESCOUT_RETURN_IF_ERROR(expr)                \
  do {                                                  \
    if (absl::Status status_ = (expr); !status_.ok()) { \
      return status_;                                   \
    }                                                   \
  } while (false)

#define PLUMESCOUT_CONCAT_INNER(a, b) a##b
#define PLUMESCOUT_CONCAT(a, b) PLUMESCOUT_CONCAT_INNER(a, b)

// PLUMESCOUT_ASSIGN_OR_RETURN(const Plan plan, planner.Plan(request));
#define PLUMESCOUT_ASSIGN_OR_RETURN(lhs, expr) \
  PLUMESCOUT_ASSIGN_OR_RETURN_IMPL(PLUMESCOUT_CONCAT(statusor_, __LINE__), lhs, expr)
#define PLUMESCOUT_ASSIGN_OR_RETURN_IMPL(result, lhs, expr) \
  auto result = (expr);                                     \
  if (!result.ok()) return result.status();                 \
  lhs = std::move(result).value()
