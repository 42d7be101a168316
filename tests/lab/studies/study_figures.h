// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lab/trials/study.h"

namespace plumescout::lab {

// Of the study's summary; the test fails if there is none of that name.
inline double FigureOf(const Study& study, const std::string& name) {
  for (const auto& [key, value] : study.summary.figures) {
    if (key == name) return value;
  }
  ADD_FAILURE() << "no figure " << name;
  return std::nan("");
}

}  // namespace plumescout::lab
