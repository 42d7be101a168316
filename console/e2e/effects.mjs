// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Whether what is clicked does something to the map: a canvas is looked at before and after.
import assert from 'node:assert/strict';
import { until } from './harness.mjs';

// A number for what is drawn. `frame`: a page, or a frame of one.
const drawn = (frame) => frame.locator('.stage > canvas').evaluate(async (canvas) => {
  for (let i = 0; i < 3; ++i) await new Promise(requestAnimationFrame);
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let sum = 7;
  for (const word of new Uint32Array(data.buffer)) sum = (Math.imul(sum, 31) + word) | 0;
  return sum;
});

// Of a map that stands still: each switch takes something away, and brings the same back.
export async function checkSwitches(frame, names) {
  await frame.locator('.tools summary').click();
  const whole = await drawn(frame);
  for (const name of names) {
    const box = frame.getByLabel(name, { exact: true });
    await box.uncheck();
    await until(`a map without ${name}`, async () => await drawn(frame) !== whole);
    await box.check();
    await until(`a map with ${name}`, async () => await drawn(frame) === whole);
  }
  await frame.locator('.tools summary').click();
}

// Of the same: every button and key that moves the map does, and Fit brings it back.
export async function checkMoves(page) {
  const canvas = page.locator('.stage > canvas');
  const readout = page.locator('.readout');
  const box = await canvas.boundingBox();
  const place = async () => {
    await page.mouse.move(box.x + box.width / 2 + 1, box.y + box.height / 2);
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    return (await readout.innerText()).split(' m · ')[0];
  };
  const whole = await place();
  const moves = [
    ['key →', () => page.keyboard.press('ArrowRight')], ['key ↑', () => page.keyboard.press('ArrowUp')],
    ['dragging', async () => {
      await page.mouse.down();
      await page.mouse.move(box.x + box.width / 2 + 80, box.y + box.height / 2 + 50, { steps: 3 });
      await page.mouse.up();
    }],
    ['Follow', () => page.getByRole('button', { name: 'Follow', exact: true }).click()]];
  for (const [name, move] of moves) {
    await canvas.focus();
    await move();
    await until(`another place after ${name}`, async () => await place() !== whole);
    await page.keyboard.press('f');
    await until(`the same place after ${name} and Fit`, async () => await place() === whole);
  }
  const scale = () => drawn(page);
  for (const [more, less] of [['+', '-'], ['Zoom in', 'Zoom out']]) {
    const before = await scale();
    const press = (what) => what.length === 1 ? page.keyboard.press(what)
      : page.getByRole('button', { name: what, exact: true }).click();
    await press(more);
    await until(`a larger map after ${more}`, async () => await scale() !== before);
    await press(less);
  }
  await page.keyboard.press('f');
}

// The middle of the mark of a frontier of the map, pixels of the page.
export async function frontierMark(page) {
  const canvas = page.locator('.stage > canvas');
  const box = await canvas.boundingBox();
  const found = await canvas.evaluate((element) => {
    const colour = getComputedStyle(document.documentElement).getPropertyValue('--frontier-occupancy').trim();
    const [r, g, b] = [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
    const { data, width, height } = element.getContext('2d').getImageData(0, 0, element.width, element.height);
    const is = (x, y) => {
      const i = 4 * (y * width + x);
      return data[i] === r && data[i + 1] === g && data[i + 2] === b;
    };
    const ratio = width / element.clientWidth;
    for (let y = 80; y < height - 40; ++y) { // below the buttons
      for (let x = 300; x < width - 40; ++x) { // beside the legend
        if (is(x, y) && is(x + 2, y) && is(x + 4, y)) return [x / ratio, y / ratio + 4];
      }
    }
    return null;
  });
  return found === null ? null : [box.x + found[0], box.y + found[1]];
}

// The middle of the mark of a robot of this colour, rgb(r, g, b), pixels of the page; null: it is not found.
export async function robotMark(page, colour) {
  const canvas = page.locator('.stage > canvas');
  const box = await canvas.boundingBox();
  const rgb = colour.match(/\d+/g).map(Number);
  const found = await canvas.evaluate((element, [r, g, b]) => {
    const { data, width, height } = element.getContext('2d').getImageData(0, 0, element.width, element.height);
    const is = (x, y) => {
      const i = 4 * (y * width + x);
      return Math.abs(data[i] - r) < 3 && Math.abs(data[i + 1] - g) < 3 && Math.abs(data[i + 2] - b) < 3;
    };
    const ratio = width / element.clientWidth;
    const reach = [-4, -2, 0, 2, 4]; // ways are thinner
    for (let y = 60; y < height - 10; ++y) {
      for (let x = 10; x < width - 10; ++x) {
        if (is(x, y) && reach.every((dx) => reach.every((dy) => is(x + dx, y + dy)))) return [x / ratio, y / ratio];
      }
    }
    return null;
  }, rgb);
  return found === null ? null : [box.x + found[0], box.y + found[1]];
}

export async function checkScales(page) {
  const legend = page.locator('.legend');
  const button = (name) => page.getByRole('button', { name, exact: true });
  await button('Gas').click();
  await legend.getByText('Gas mean, ppm (logarithmic)').waitFor();
  const ticks = () => legend.locator('.ticks').innerText();
  const logarithmic = await ticks();
  await button('Log').click();
  await legend.getByText('Gas mean, ppm', { exact: true }).waitFor();
  assert.notEqual(await ticks(), logarithmic);
  await button('Log').click();
  await button('Uncertainty').click();
  await legend.getByText('Uncertainty, one σ, ppm').waitFor();
  await button('Walls').click();
  assert.equal(await legend.locator('.ticks').count(), 0);
  await button('Gas').click();
}
