// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What pointers do to a map: look, pan, pinch, click, and draw areas. Mouse, pen or fingers.
import type { AreaDraft } from './area_draft.ts';
import type { Place } from './scene.ts';

// A pointer that moves farther, pixels, drags.
const DRAG = 4;
// A corner this near, pixels, is the same one.
const NEAR_CORNER = 10;

// Places on the canvas are in pixels.
export type PointedMap = {
  draft(): AreaDraft | null; // what is drawn, if anything is
  drawn(): void; // the draft has changed
  placeAt(x: number, y: number): Place;
  scale(): number; // pixels a metre
  hover(at: [number, number] | null): void;
  pan(dx: number, dy: number): void;
  zoom(by: number, x: number, y: number): void;
  click(x: number, y: number): void;
};

export function listenToPointers(canvas: HTMLCanvasElement, map: PointedMap): void {
  const pointers = new Map<number, [number, number]>();
  let moved = 0;
  let pinches = false; // or did, until all fingers are off
  const place = (event: { clientX: number; clientY: number }): [number, number] => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    map.hover(place(event)); // fingers do not move there first
    pointers.set(event.pointerId, place(event));
    moved = 0;
    pinches = pointers.size > 1;
    const draft = map.draft();
    if (draft === null) return;
    if (!pinches) draft.press(map.placeAt(...place(event)));
    else if (draft.drags) draft.clear();
    map.drawn();
  });
  canvas.addEventListener('pointermove', (event) => {
    const now = place(event);
    map.hover(now);
    const draft = map.draft();
    if (draft !== null && !pinches) {
      draft.move(map.placeAt(...now));
      map.drawn();
    }
    const before = pointers.get(event.pointerId);
    if (before === undefined) return;
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    moved += Math.hypot(now[0] - before[0], now[1] - before[1]);
    if (moved > DRAG && other === undefined) {
      if (!draft?.drags) map.pan(now[0] - before[0], now[1] - before[1]);
    } else if (other !== undefined) {
      const spread = (p: [number, number]) => Math.hypot(p[0] - other[0], p[1] - other[1]) + 1;
      map.zoom(spread(now) / spread(before), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
    }
    pointers.set(event.pointerId, now);
  });
  const end = (event: PointerEvent) => {
    if (!pointers.delete(event.pointerId) || event.type === 'pointercancel') return;
    const draft = map.draft();
    if (draft !== null) {
      if (pinches) return;
      draft.release(map.placeAt(...place(event)), moved > DRAG, NEAR_CORNER / map.scale());
      return map.drawn();
    }
    if (moved <= DRAG) map.click(...place(event));
  };
  canvas.addEventListener('pointerup', end);
  canvas.addEventListener('pointercancel', end);
  canvas.addEventListener('pointerleave', (event) => {
    if (event.pointerType !== 'touch') map.hover(null); // what a finger asked is read once it is off
  });
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    map.zoom(Math.exp(-event.deltaY * 0.0015), ...place(event));
  }, { passive: false });
}
