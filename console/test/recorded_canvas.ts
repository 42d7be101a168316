// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Canvases that write down what is drawn on them, and a style sheet, for tests without a browser.

export type Stroke = { call: string; args: unknown[]; fill: string; stroke: string; alpha: number; width: number; dash: number[] };

export class RecordedContext {
  readonly strokes: Stroke[] = [];
  fillStyle = '';
  strokeStyle = '';
  globalAlpha = 1;
  lineWidth = 1;
  private dash: number[] = [];

  constructor() {
    return new Proxy(this, { get: (target, name, self) => {
      if (typeof name !== 'string' || name in target) return Reflect.get(target, name, self);
      return (...args: unknown[]) => target.write(name, args);
    } });
  }
  setLineDash(dash: number[]): void {
    this.dash = dash;
  }
  of(call: string): Stroke[] {
    return this.strokes.filter((one) => one.call === call);
  }
  // To a hundredth of a pixel.
  points(...calls: string[]): [number, number][] {
    return this.strokes.filter(({ call }) => calls.includes(call))
      .map(({ args: [x, y] }) => [x, y].map((v) => Math.round(100 * (v as number)) / 100) as [number, number]);
  }
  texts(): unknown[] {
    return this.of('fillText').map(({ args }) => args[0]);
  }
  clear(): void {
    this.strokes.length = 0;
  }
  private write(call: string, args: unknown[]): void {
    this.strokes.push({ call, args, fill: this.fillStyle, stroke: this.strokeStyle, alpha: this.globalAlpha,
                        width: this.lineWidth, dash: this.dash });
  }
}

export const contextOf = (recorded: RecordedContext) => recorded as unknown as CanvasRenderingContext2D;

// Colours are their names, but for those that are read as numbers.
export function styleSheet(numbers: Record<string, string> = {}): void {
  const valueOf = (name: string) => numbers[name] ?? name;
  Object.assign(globalThis, {
    window: { devicePixelRatio: 2 },
    document: { documentElement: { dataset: {} }, createElement: () => recordedCanvas() },
    getComputedStyle: () => ({ getPropertyValue: valueOf }),
    ImageData: class {
      readonly data: Uint8ClampedArray;
      constructor(readonly width: number, readonly height: number) {
        this.data = new Uint8ClampedArray(4 * width * height);
      }
    },
  });
}

export function recordedCanvas(width = 300, height = 100) {
  const context = new RecordedContext();
  return { width, height, clientWidth: width, clientHeight: height, getContext: () => context, context };
}
