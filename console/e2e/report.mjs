// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A report of plumescout-lab, opened as a file: looked around in without a server, and printed.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { checkSwitches } from './effects.mjs';
import { BIN, PATIENCE_MS, data } from './harness.mjs';

const PRINTED_PAGE = /\/Type\s*\/Page\b/g;

export async function lookAround(browser, scene, out) {
  const folder = join(data, 'report');
  execFileSync(join(BIN, 'plumescout-lab'), ['robot', '--record', join(data, 'report.journal'), '--scene',
    resolve(scene), '--robots', '2', '--duration', '60', '--objective', 'map_above_threshold',
    '--objective-threshold', '10', '--out', folder], { stdio: 'ignore' });
  const page = await browser.newPage({ viewport: { width: 1280, height: 1100 } });
  const wrong = [];
  page.on('pageerror', (error) => wrong.push(error.message));
  page.on('request', (request) => { if (!/^(file|data|about):/.test(request.url())) wrong.push(request.url()); });
  await page.goto(pathToFileURL(join(folder, 'report.html')).href);
  const explorer = page.frameLocator('iframe.explorer');
  await explorer.getByText('The map when the mission ended').waitFor({ timeout: PATIENCE_MS });

  // What it was for: in the page, on a map of its own, and in what is looked around in.
  await page.getByRole('heading', { name: 'What the mission was for' }).waitFor();
  await page.getByRole('cell', { name: 'map where there is more than 10 ppm, 95 % sure' }).waitFor();
  await page.getByRole('img', { name: 'Objective' }).waitFor();
  await explorer.getByRole('heading', { name: 'What it was for' }).waitFor();
  await explorer.getByRole('button', { name: 'Objective' }).click();
  for (const outlook of ['below', 'above', 'unmeasured']) await explorer.locator(`.legend .m-${outlook}`).waitFor();
  await page.screenshot({ path: join(out, 'report_objective.png') });
  await explorer.getByRole('button', { name: 'Gas' }).click();

  const map = explorer.locator('.stage > canvas');
  await map.hover();
  assert.match(await explorer.locator('.readout').innerText(), /m · (free|occupied|unknown|off the map)/);
  await explorer.getByRole('slider', { name: 'Plan to look at' }).fill('0');
  await explorer.getByText(/^plan 1 of \d+/).waitFor();
  await explorer.getByText(/goals it could drive to/).waitFor();
  await page.screenshot({ path: join(out, 'report.png') });
  await checkSwitches(explorer, ['ways of robots', 'claimed goals', 'trails', 'frontiers', 'names', 'candidates of the plan',
    'keep-out and homes']);
  await explorer.getByRole('button', { name: 'Error' }).click();
  await explorer.getByText('Estimated gas mean less the true one, ppm').waitFor();
  await explorer.getByRole('button', { name: 'Truth' }).click();
  assert.equal(await explorer.getByRole('button', { name: 'Truth' }).getAttribute('aria-pressed'), 'true');

  const printed = (await page.pdf({ preferCSSPageSize: true })).toString('latin1');
  assert.equal(printed.match(PRINTED_PAGE)?.length, 1, 'the report prints to one sheet');
  assert.deepEqual(wrong, []);
  await page.close();
}

// A report that the console saved: it stands by itself.
export async function openSaved(browser, html, out, says) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  const wrong = [];
  page.on('pageerror', (error) => wrong.push(error.message));
  page.on('request', (request) => { if (!/^(file|data|about):/.test(request.url())) wrong.push(request.url()); });
  const file = join(data, 'saved.html');
  writeFileSync(file, html);
  await page.goto(pathToFileURL(file).href);
  for (const words of says) await page.getByText(words).first().waitFor({ timeout: PATIENCE_MS });
  await page.getByRole('button', { name: 'Objective' }).click();
  for (const mark of ['m-below', 'm-home']) await page.locator(`.legend .${mark}`).waitFor();
  await page.screenshot({ path: join(out, 'report_saved.png') });
  assert.equal(await page.getByRole('button', { name: 'Change' }).count(), 0);
  assert.deepEqual(wrong, []);
  await page.close();
}
