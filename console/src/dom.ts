// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Elements by a call each: h('button', {class: 'danger', onclick: f}, 'Delete').

type Child = Node | string | number | null | undefined | false;
type Attributes = Record<string, string | number | boolean | null | undefined | ((event: never) => void)>;

export function h<K extends keyof HTMLElementTagNameMap>(
  name: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === 'function') {
      element.addEventListener(key.slice(2), value as EventListener);
    } else {
      element.setAttribute(key, value === true ? '' : String(value));
    }
  }
  fill(element, ...children);
  return element;
}

export function fill(element: Element, ...children: Child[]): void {
  element.replaceChildren(...children
    .filter((child) => child !== null && child !== undefined && child !== false)
    .map((child) => (child instanceof Node ? child : String(child))));
}

// Shows `key`'s worth of content, and leaves the element alone while that does not change, so that
// what people point at and type into stays.
const shown = new WeakMap<Element, string>();
export function fillIfChanged(element: Element, key: string, make: () => Child[]): void {
  if (shown.get(element) === key) return;
  shown.set(element, key);
  fill(element, ...make());
}

// As fill(); if a button or a choice had the focus, the one of its name has it then, so that keys go on there.
export function refill(bar: Element, ...children: Child[]): void {
  const nameOf = (button: Element) => button.getAttribute('aria-label') ?? button.textContent;
  const focused = bar.contains(document.activeElement) ? nameOf(document.activeElement!) : null;
  fill(bar, ...children);
  if (focused === null) return;
  [...bar.querySelectorAll<HTMLElement>('button, summary, select')].find((button) => nameOf(button) === focused)?.focus();
}

// Where a key leads to from place `at` of a row of so many tabs; null: it leads nowhere.
export function tabOfKey(key: string, at: number, count: number): number | null {
  switch (key) {
    case 'ArrowLeft': return (at + count - 1) % count;
    case 'ArrowRight': return (at + 1) % count;
    case 'Home': return 0;
    case 'End': return count - 1;
    default: return null;
  }
}

export function saveFile(name: string, parts: BlobPart[], type = 'application/octet-stream'): void {
  const url = URL.createObjectURL(new Blob(parts, { type }));
  const link = h('a', { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

// Asks before something that cannot be undone.
export function ask(title: string, text: string, verb: string): Promise<boolean> {
  return new Promise((resolve) => {
    const close = (answer: boolean) => {
      dialog.close();
      dialog.remove();
      resolve(answer);
    };
    const dialog = h('dialog', { class: 'ask', 'aria-label': title, oncancel: () => close(false) },
      h('h2', {}, title),
      h('p', {}, text),
      h('div', { class: 'row end' },
        h('button', { onclick: () => close(false) }, 'Cancel'),
        h('button', { class: 'danger', onclick: () => close(true) }, verb)));
    document.body.append(dialog);
    dialog.showModal();
  });
}

let noticeTimer = 0;
export function notice(text: string, kind: 'good' | 'bad' = 'good'): void {
  const box = document.getElementById('notice')!;
  box.className = `notice ${kind}`;
  box.textContent = text;
  clearTimeout(noticeTimer);
  noticeTimer = window.setTimeout(() => { box.textContent = ''; box.className = 'notice'; },
                                  kind === 'bad' ? 9000 : 4000);
}
