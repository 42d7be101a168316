// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cmake/precompiled/tests.h"
#include "cmake/precompiled/wire.h"
