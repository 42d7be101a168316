// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Which of a mission's gases is looked at, and what that means for what is said of gas.
import type { GasCounters, MapStatus } from '@plumescout/client/wire';

export type Gases = {
  names: string[]; // in the mission's order; empty: it has one, without a name
  looked: string; // whose map is looked at; empty: the first's
};

export const isFirst = ({ names, looked }: Gases) => looked === '' || looked === names[0];

// Behind what is said of gas: which one it is, where there are several.
export function ofGas({ names, looked }: Gases): string {
  return names.length < 2 ? '' : ` of ${looked === '' ? names[0] : looked}`;
}

// What plans, frontiers and the objective are of, where that could be another one.
export function ofPlans({ names }: Gases): string {
  return names.length < 2 ? '' : `Plans, gas frontiers and the objective go by ${names[0]}.`;
}

export function countersOf(status: MapStatus, { looked }: Gases): GasCounters | undefined {
  return status.gases.find(({ species }) => species === looked)?.gasCounters ?? status.gasCounters;
}
