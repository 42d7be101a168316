// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Maps of values to colours that can be told apart with any colour vision: lightness rises evenly in
// Oklab, and hue only helps. https://bottosson.github.io/posts/oklab/

export type Rgb = [number, number, number];

function gamma(linear: number): number {
  const value = linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
  return Math.round(255 * Math.min(1, Math.max(0, value)));
}

// Linear sRGB.
function linearOf(lightness: number, chroma: number, hue_deg: number): Rgb {
  const hue = (hue_deg * Math.PI) / 180;
  const a = chroma * Math.cos(hue), b = chroma * Math.sin(hue);
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
}

// As colourful as asked for, or as sRGB can be at this lightness and hue.
export function oklch(lightness: number, chroma: number, hue_deg: number): Rgb {
  let linear = linearOf(lightness, chroma, hue_deg);
  while (chroma > 1e-3 && linear.some((value) => value < -1e-4 || value > 1.0001)) {
    chroma *= 0.97;
    linear = linearOf(lightness, chroma, hue_deg);
  }
  return linear.map(gamma) as Rgb;
}

// Of sRGB, the lightness of Oklab.
export function lightnessOf([r, g, b]: Rgb): number {
  const linear = (value: number) => {
    const v = value / 255;
    return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  };
  const [x, y, z] = [linear(r), linear(g), linear(b)];
  const l = Math.cbrt(0.4122214708 * x + 0.5363325363 * y + 0.0514459929 * z);
  const m = Math.cbrt(0.2119034982 * x + 0.6806995451 * y + 0.1073969566 * z);
  const s = Math.cbrt(0.0883024619 * x + 0.2817188376 * y + 0.6299787005 * z);
  return 0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s;
}

export const STEPS = 256;
export type Colours = Rgb[];

function ramp(colour: (t: number) => Rgb): Colours {
  return Array.from({ length: STEPS }, (_, i) => colour(i / (STEPS - 1)));
}

// Gas: from dark blue by green to yellow.
export const GAS = ramp((t) => oklch(0.26 + 0.68 * t, 0.085 + 0.075 * Math.sin(Math.PI * t) ** 0.8 +
                                     0.05 * t * t, 285 - 178 * t ** 0.9));
// Uncertainty: from nearly nothing to purple, so that it is never taken for gas.
export const UNCERTAINTY = ramp((t) => oklch(0.97 - 0.62 * t, 0.16 * t ** 0.8, 320));
// Differences: blue is less, orange is more, and the middle is no change.
export const CHANGE = ramp((t) => {
  const side = 2 * t - 1;
  return oklch(0.96 - 0.42 * Math.abs(side), 0.16 * Math.abs(side), side < 0 ? 255 : 50);
});

export type Scale = { min: number; max: number; log: boolean };

// Where a value stands between the ends of a scale, 0 to 1.
export function shareOf(scale: Scale, value: number): number {
  const share = scale.log
    ? Math.log(Math.max(value, scale.min) / scale.min) / Math.log(scale.max / scale.min)
    : (value - scale.min) / (scale.max - scale.min);
  return Math.min(1, Math.max(0, share));
}

// The least of 1, 2 and 5 times a power of ten that is not below the value: ends of scales that stay
// while values grow a little.
export function roundUp(value: number): number {
  if (!(value > 0) || !Number.isFinite(value)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  for (const step of [1, 2, 5, 10]) {
    if (step * power >= value * (1 - 1e-9)) return step * power;
  }
  return 10 * power;
}

// Values for the legend, in order.
export function ticksOf(scale: Scale): number[] {
  if (!scale.log) return [0, 1, 2, 3, 4].map((i) => scale.min + ((scale.max - scale.min) * i) / 4);
  const ticks: number[] = [];
  for (let power = Math.ceil(Math.log10(scale.min) - 1e-9); 10 ** power <= scale.max * (1 + 1e-9);
       ++power) {
    ticks.push(10 ** power);
  }
  return ticks;
}
