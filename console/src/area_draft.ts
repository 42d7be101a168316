// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// An area while it is drawn: a rectangle by two corners, dragged or clicked, or a polygon corner by
// corner. Places are in metres.
export type Place = { x_m: number; y_m: number };
export type Shape = 'rectangle' | 'polygon';

const MOST_CORNERS = 256;

export class AreaDraft {
  // Nothing more has to be drawn; the next press begins anew.
  done = false;
  private corners: Place[] = [];
  private pointer: Place | null = null;

  constructor(readonly shape: Shape) {}

  // Whether a drag draws; else it moves the map.
  get drags(): boolean {
    return this.shape === 'rectangle';
  }

  press(place: Place): void {
    if (this.shape !== 'rectangle') return;
    if (this.done) this.clear();
    if (this.corners.length === 0) this.corners = [place];
    this.pointer = place;
  }
  move(place: Place): void {
    if (!this.done) this.pointer = place;
  }
  // `moved`: the pointer was elsewhere when it was pressed. A corner of a polygon within `near_m` of
  // the first one closes it.
  release(place: Place, moved: boolean, near_m: number): void {
    this.move(place);
    if (this.shape === 'rectangle') {
      const [first] = this.corners;
      if (first === undefined) return;
      const isFlat = Math.abs(place.x_m - first.x_m) < near_m || Math.abs(place.y_m - first.y_m) < near_m;
      if (!isFlat) this.done = true;
      return;
    }
    if (moved || this.done) return;
    const [first] = this.corners;
    const closes = this.corners.length >= 3 &&
      Math.hypot(place.x_m - first.x_m, place.y_m - first.y_m) < near_m;
    if (!closes) this.corners.push(place);
    this.done = closes || this.corners.length === MOST_CORNERS;
  }
  // The last corner of a polygon, or what was drawn of a rectangle.
  undo(): void {
    if (this.shape === 'rectangle') return this.clear();
    if (!this.done) this.corners.pop();
    this.done = false;
  }
  clear(): void {
    this.corners = [];
    this.pointer = null;
    this.done = false;
  }

  // As it would be if it ended here; fewer than three corners: it is none yet.
  area(): Place[] {
    if (this.shape === 'polygon') return [...this.corners];
    const [from] = this.corners;
    if (from === undefined || this.pointer === null) return [];
    const to = this.pointer;
    if (from.x_m === to.x_m || from.y_m === to.y_m) return [];
    return [from, { x_m: to.x_m, y_m: from.y_m }, to, { x_m: from.x_m, y_m: to.y_m }];
  }
  // To be shown: with the place that the pointer is at.
  outline(): Place[] {
    if (this.shape === 'rectangle') return this.area();
    return this.done || this.pointer === null ? [...this.corners] : [...this.corners, this.pointer];
  }
}

// "area-1", "area-2", ... as it is free.
export function freeName(taken: string[]): string {
  let number = 1;
  while (taken.includes(`area-${number}`)) ++number;
  return `area-${number}`;
}
