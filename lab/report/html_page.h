// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lab/report/sheet.h"

namespace plumescout::lab {

// The page: one HTML document that loads nothing.
std::string MakeHtmlPage(const ReportFigures& figures);

}  // namespace plumescout::lab
