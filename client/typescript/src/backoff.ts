// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Waits between attempts on a broken link.

export type BackoffOptions = {
  first_s: number;
  longest_s: number;
  factor: number;
  jitter: number; // share by which each wait is spread, so that clients do not return in step
};

// Waits that grow up to a bound, each times a random factor in [1 - jitter, 1 + jitter].
export class Backoff {
  private base_s: number;

  constructor(private readonly options: BackoffOptions,
              private readonly random: () => number = Math.random) {
    this.base_s = options.first_s;
  }
  next_s(): number {
    const { longest_s, factor, jitter } = this.options;
    const wait_s = this.base_s * (1 + jitter * (2 * this.random() - 1));
    this.base_s = Math.min(factor * this.base_s, longest_s);
    return Math.min(wait_s, longest_s);
  }
  reset(): void {
    this.base_s = this.options.first_s;
  }
}

// Ends early when the signal says so.
export function pause(seconds: number, signal?: AbortSignal): Promise<void> {
  return new Promise((resolve) => {
    if (signal?.aborted === true) return resolve();
    const end = () => {
      clearTimeout(timer);
      signal?.removeEventListener('abort', end);
      resolve();
    };
    const timer = setTimeout(end, 1000 * seconds);
    signal?.addEventListener('abort', end);
  });
}
