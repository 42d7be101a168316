// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Colours of the style sheet, for what is drawn on canvases. Looked up once a theme.
const known = new Map<string, string>();
let knownOf: string | undefined;

export function theme(name: string): string {
  const { theme: now } = document.documentElement.dataset;
  if (now !== knownOf) {
    known.clear();
    knownOf = now;
  }
  let value = known.get(name);
  if (value === undefined) {
    value = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    if (value !== '') known.set(name, value);
  }
  return value;
}
