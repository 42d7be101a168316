// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// For browsers: gRPC-Web, to the server's --http. Methods that stream requests are not for these.
import { createGrpcWebTransport } from '@connectrpc/connect-web';
import { identify, patient } from './calls.ts';
import type { CallOptions } from './calls.ts';
import { Client } from './client.ts';

export * from './index.ts';

/** address: of the server's console, or of the front before it, 'https://console.example'. */
export function connect(address: string, options: CallOptions = {}): Client {
  return new Client(patient(createGrpcWebTransport({
    baseUrl: address,
    interceptors: [identify(options.token)],
  }), options));
}
