// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/plan/sampling/sampling_rule.h"
#include "core/plan/sampling/site_lattice.h"

namespace plumescout {

// Most sites of a survey: for that many the integer program of its tour takes milliseconds to
// seconds, for more it may take minutes.
inline constexpr int kMaxSurveySites = 64;

// kInvalidArgument naming the stride and the lattice, unless every stride-th site from the first on
// has the last row and column among them, and they are at most kMaxSurveySites.
absl::Status CheckSurvey(const SiteLattice& lattice, int stride);

// What is left of the low-resolution survey, [LHR] section III-A, in the order to drive: the
// survey's sites that are not sampled yet, along the shortest closed tour (P1) of all that are
// offered. It begins where, and goes the way round that, makes the whole drive from the robot the
// shortest: of a tour with equal legs, at the site nearest to the robot. The leg back is not
// driven. Empty if nothing is left.
//
// The tour's edges lead to neighbours in the mesh, Eq. (2), and cost what the way there is long.
// If obstacles leave no such tour, they lead from every site to every other (ours).
// Errors: kDeadlineExceeded if stopped, kInternal from the solver.
absl::StatusOr<std::vector<Site>> RestOfSurvey(const SamplingQuery& query);

}  // namespace plumescout
