#!/bin/sh
# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
# Usage: robot_links_test.sh PROGRAM. Fails if the robot's program links what robots must not carry:
# SuiteSparse (GPL modules), OMPL, or the linear algebra beneath them.
set -eu
libraries=$(ldd "$1")
if printf '%s\n' "$libraries" | grep -E 'lib(cholmod|suitesparse|amd|camd|colamd|ccolamd|metis|ompl|openblas|lapack|blas)'; then
  echo "$1 links the libraries above" >&2
  exit 1
fi
printf '%s\n' "$libraries" | grep -q libgrpc  # the list is that of the right program
