// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What the address of a page says: #/missions/hall@120?gas=methane.

export type Address = {
  path: string; // missions/hall
  revision: bigint | null; // null: as it is now
  gas: string; // that the map is of; empty: the mission's first
};

export function addressOf(hash: string): Address {
  const [place, query = ''] = hash.slice(2).split('?');
  const [path, revision] = decodeURI(place).split('@');
  return { path, revision: revision === undefined ? null : BigInt(`0${revision.replace(/\D/g, '')}`),
           gas: new URLSearchParams(query).get('gas') ?? '' };
}

export function hashOf({ path, revision, gas }: Address): string {
  return `#/${path}${revision === null ? '' : `@${revision}`}${gas === '' ? '' : `?${new URLSearchParams({ gas })}`}`;
}
