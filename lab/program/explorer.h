// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/strings/string_view.h"
#include "lab/program/run.h"

namespace plumescout::lab {

// Where a page of the console's stands that draws one mission without a server: beside this
// program, in ../share/plumescout/report.html, where scripts/console puts it. Empty if it is not
// there.
std::string ReadExplorerPage();

// The page with what it draws: the map at the end and the truth, the ways that robots drove from
// their homes, and every plan with what it was chosen from, and how the objective stands if it has
// one. All as the wire has it, for the page reads it with what the console reads missions with.
// Empty if `page` is, or has no place for a mission.
std::string MakeExplorer(absl::string_view page, const Run& run);

}  // namespace plumescout::lab
