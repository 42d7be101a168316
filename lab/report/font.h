// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo.h>

#include <string>
#include <vector>

#include "absl/strings/string_view.h"

namespace plumescout::lab {

// Of what is written next: DejaVu Sans, or what the system has in its place. Letters have the same
// shapes and widths at every scale and in every kind of figure.
void SelectFont(cairo_t* context, double size_px, bool bold);

// The text as it can be written: bytes that are no UTF-8 become U+FFFD.
std::string Writable(absl::string_view text);

// How far the text reaches.
double TextWidth_px(absl::string_view utf8, double size_px, bool bold = false);

// `size_px`, or less if the text would be wider than `width_px` with it.
double SizeToFit_px(absl::string_view utf8, double size_px, double width_px, bool bold = false);

// The text in lines that are no wider, broken at spaces; a longer word has a line of its own.
std::vector<std::string> WrapText(absl::string_view utf8, double size_px, double width_px);

}  // namespace plumescout::lab
