// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Follows a mission: a line whenever its map has changed, and the map as files of map_server.
//
//   node watch.ts [TARGET [MISSION]]      Node 22.18 or newer; before, through tsx or esbuild
import { writeFileSync } from 'node:fs';
import { connect, figuresOf, mapYamlOf, pgmOf, watchMap } from '@plumescout/client';

const [target = '127.0.0.1:50551', mission = 'room'] = process.argv.slice(2);
const client = connect(target);
const end = new AbortController();
process.once('SIGINT', () => end.abort());

const updates = watchMap(client, `missions/${mission}`, {
  signal: end.signal,
  onLink: (state, error, again_s) => {
    if (state === 'waiting') console.log(`${error?.message ?? 'the stream has ended'}; again in ${again_s.toFixed(1)} s`);
  },
});
for await (const { raster, status, revision } of updates) {
  if (raster === null) {
    console.log(`revision ${revision}: no map yet`);
    continue;
  }
  const { known_m2, plume_m2, max_ppm } = figuresOf(raster, status.gasThresholdPpm);
  console.log(`revision ${revision}: ${known_m2.toFixed(1)} m² known, plume ${plume_m2.toFixed(1)} m², ` +
              `at most ${max_ppm.toFixed(1)} ppm, ${status.robots.length} robots`);
  writeFileSync(`${mission}.pgm`, pgmOf(raster));
  writeFileSync(`${mission}.yaml`, mapYamlOf(raster, `${mission}.pgm`));
}
client.close();
