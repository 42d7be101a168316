// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// A signal that follows another, and is also given when its user comes to an end: streams that
// nobody reads any more are to be cancelled.
export class OwnAbort {
  private readonly controller = new AbortController();
  readonly signal = this.controller.signal;
  private readonly follow = () => this.controller.abort(this.parent?.reason);

  constructor(private readonly parent?: AbortSignal) {
    parent?.addEventListener('abort', this.follow);
    if (parent?.aborted === true) this.follow();
  }
  end(): void {
    this.parent?.removeEventListener('abort', this.follow);
    this.controller.abort();
  }
}
