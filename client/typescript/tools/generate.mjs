// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Makes src/wire from the project's proto folder: messages and services in TypeScript, all of them in
// one index.ts, and what the comments of the options say, which forms show as help. Needs protoc.
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { fromBinary } from '@bufbuild/protobuf';
import { FileDescriptorSetSchema } from '@bufbuild/protobuf/wkt';

const PROTO = '../../proto';
const PLUGIN = '../../node_modules/.bin/protoc-gen-es';
const OUT = 'src/wire';
const SET = 'build/options.binpb';

rmSync(OUT, { recursive: true, force: true });
mkdirSync(OUT, { recursive: true });
mkdirSync('build', { recursive: true });
const files = ['plumescout/v1', 'google/rpc'].flatMap((folder) =>
  readdirSync(`${PROTO}/${folder}`).filter((name) => name.endsWith('.proto'))
    .map((name) => `${folder}/${name}`));
const protoc = (...args) => execFileSync('protoc', ['-I', PROTO, ...args], { stdio: 'inherit' });
protoc(`--plugin=${PLUGIN}`, `--es_out=${OUT}`,
       '--es_opt=target=ts,import_extension=ts', ...files);
// Of google.rpc only the details of errors: its other messages have names that say little here.
writeFileSync(`${OUT}/index.ts`, '// Generated: all that is on the wire.\n' +
  files.filter((name) => name.startsWith('plumescout/') || name.endsWith('error_details.proto'))
    .map((name) => `export * from './${name.replace(/\.proto$/, '_pb.ts')}';\n`).join(''));
protoc('--include_source_info', `--descriptor_set_out=${SET}`, 'plumescout/v1/options.proto');

const MESSAGE = 4, FIELD = 2; // of FileDescriptorProto and DescriptorProto
const help = {};
for (const file of fromBinary(FileDescriptorSetSchema, readFileSync(SET)).file) {
  for (const location of file.sourceCodeInfo?.location ?? []) {
    const [kind, message, member, field] = location.path;
    if (location.path.length !== 4 || kind !== MESSAGE || member !== FIELD) continue;
    const type = file.messageType[message];
    help[`${file.package}.${type.name}.${type.field[field].name}`] =
      location.leadingComments.trim().replace(/\s*\n\s*/g, ' ');
  }
}
writeFileSync(`${OUT}/option_help.ts`, '// Generated from the comments of options.proto.\n' +
  `export const OPTION_HELP: Record<string, string> = ${JSON.stringify(help, null, 2)};\n`);
