// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// For Node: gRPC over HTTP/2, to the server's --listen.
import { readFileSync } from 'node:fs';
import { Code, ConnectError } from '@connectrpc/connect';
import type { Interceptor } from '@connectrpc/connect';
import { Http2SessionManager, createGrpcTransport } from '@connectrpc/connect-node';
import { identify, patient } from './calls.ts';
import type { CallOptions } from './calls.ts';
import { Client } from './client.ts';

export * from './index.ts';
export { importMission } from './import_mission.ts';
export { RobotSession } from './robot_session.ts';
export type {
  BatterySample, GasSample, LogOptions, PlanOptions, Pose, PoseFix, Refusal, RegisterOptions, ScanSample,
  SessionStatistics,
} from './robot_session.ts';

/** Files are PEM. */
export type ConnectOptions = CallOptions & {
  caFile?: string; // authorities of the server's certificate; absent: plaintext
  certificateFile?: string; // the client's own, with its key
  keyFile?: string;
  tokenFile?: string; // holds the token on its first line; read again at every call
};

const KEEPALIVE = { pingIntervalMs: 10_000, pingTimeoutMs: 5_000 }; // the server's least interval

/** target: of the server's --listen, '127.0.0.1:50551'. Throws if a file cannot be read. */
export function connect(target = '127.0.0.1:50551', options: ConnectOptions = {}): Client {
  const { caFile, certificateFile, keyFile, tokenFile } = options;
  const read = (file: string | undefined) => (file === undefined ? undefined : readFileSync(file));
  if ((certificateFile === undefined) !== (keyFile === undefined)) {
    throw new Error('a certificate and its key come together');
  }
  if (certificateFile !== undefined && caFile === undefined) {
    throw new Error('a certificate is for TLS: name caFile, too');
  }
  const tls = { ca: read(caFile), cert: read(certificateFile), key: read(keyFile) };
  const baseUrl = `${caFile === undefined ? 'http' : 'https'}://${target}`;
  const token = tokenFile === undefined ? options.token
    : () => readFileSync(tokenFile, 'utf8').split('\n')[0]!.trim();
  const sessionManager = new Http2SessionManager(baseUrl, KEEPALIVE, caFile === undefined ? {} : tls);
  let closed = false; // the manager would connect anew
  const whileOpen: Interceptor = (next) => async (request) => {
    if (closed) throw new ConnectError('the client is closed', Code.Canceled);
    return next(request);
  };
  return new Client(patient(createGrpcTransport({
    baseUrl, sessionManager, interceptors: [whileOpen, identify(token)],
  }), options), () => {
    closed = true;
    sessionManager.abort();
  });
}
