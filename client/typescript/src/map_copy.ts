// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A reader's copy of a map, kept by frames; no network, no clock.
import { Raster, geometryOf, sameGeometry } from './raster.ts';
import type { CellRect } from './raster.ts';
import { WatchMapResponse_Kind } from './wire/index.ts';
import type { WatchMapResponse } from './wire/index.ts';

/** Of larger maps squares of cells are shown: four million take 36 MB. */
export const MAX_CELLS = 4_000_000;

/** The level of detail at which so many cells are few enough. */
export function levelFor(cells: number, max_cells = MAX_CELLS): number {
  let level = 0;
  while (cells / 4 ** level > max_cells && level < 6) ++level;
  return level;
}

export class MapCopy {
  raster: Raster | null = null;
  revision = -1n;

  /** Returns what to draw: all, some cells, or nothing. */
  apply(frame: WatchMapResponse): 'all' | CellRect[] {
    const kind = frame.kind;
    if (kind === WatchMapResponse_Kind.RESET) {
      this.raster = null;
      this.revision = -1n;
      return [];
    }
    let all = false;
    const geometry = geometryOf(frame.tileGeometry) ?? geometryOf(frame.status?.geometry);
    if (kind === WatchMapResponse_Kind.FULL) {
      this.raster = geometry === null ? null : new Raster(geometry);
      all = true;
    } else if (kind === WatchMapResponse_Kind.DELTA) {
      if (this.raster === null || frame.baseRevision !== this.revision ||
          (geometry !== null && !sameGeometry(geometry, this.raster.geometry))) {
        throw new Error('a change of a map that is not here');
      }
    }
    const rects: CellRect[] = [];
    for (const tile of frame.tiles) {
      if (this.raster === null) throw new Error('a tile of a map that is not here');
      rects.push(this.raster.apply(tile));
    }
    this.revision = frame.revision;
    return all ? 'all' : rects;
  }
}
