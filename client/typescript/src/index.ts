// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What is the same in Node and in browsers.
export { requestId } from './calls.ts';
export type { CallOptions } from './calls.ts';
export { Client, all } from './client.ts';
export { Code, errorOf, isFinal } from './errors.ts';
export type { CallError } from './errors.ts';
export { mapYamlOf, npyOf, pgmOf } from './export.ts';
export { MAX_CELLS, levelFor } from './map_copy.ts';
export { getMap, watchMap } from './maps.ts';
export type {
  DecodedMap, GetMapOptions, LinkState, MapOptions, MapUpdate, WatchMapOptions,
} from './maps.ts';
export { exportMission } from './mission_file.ts';
export type { ExportOptions, FilePiece } from './mission_file.ts';
export { planOf } from './plan.ts';
export type { Plan } from './plan.ts';
export { encodeRanges } from './ranges.ts';
export {
  FREE, OCCUPIED, Raster, UNKNOWN, changeOf, figuresOf, geometryOf, sameGeometry,
} from './raster.ts';
export type { CellRect, Geometry, RasterFigures } from './raster.ts';
export { watchRobot } from './watch_robot.ts';
export type { RobotNotice } from './watch_robot.ts';
