// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
import { h, fill } from './dom.ts';
import { addressOf } from './address.ts';
import { MissionPage } from './mission_page.ts';
import { listPage, newPage, servicePage } from './pages.ts';
import type { Page } from './pages.ts';

const THEME_KEY = 'plumescout.theme';

function applyTheme(theme: string): void {
  document.documentElement.dataset.theme = theme;
  window.dispatchEvent(new Event('themechange'));
}

function currentTheme(): string {
  return localStorage.getItem(THEME_KEY) ??
    (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light');
}

function toggleTheme(): void {
  const next = currentTheme() === 'dark' ? 'light' : 'dark';
  localStorage.setItem(THEME_KEY, next);
  applyTheme(next);
}

const KEYS: [string, string][] = [
  ['f', 'show all of the map'], ['+ −', 'zoom'], ['← ↑ → ↓', 'pan'], ['c', 'follow the robot'],
  ['1 2 3 4 5', 'gas, uncertainty, change, walls, objective'], ['g', 'logarithmic or linear scale'],
  ['s', 'the pinned moment beside this one'],
  ['Esc', 'stop drawing an area'], ['space', 'play or stop what was'], ['l', 'back to live'], ['d', 'dark or light'], ['?', 'this list']];

function showKeys(): void {
  const dialog = h('dialog', { 'aria-label': 'Keys', onclose: () => dialog.remove() },
    h('h2', {}, 'Keys'),
    h('table', {}, h('tbody', {}, ...KEYS.map(([key, what]) =>
      h('tr', {}, h('td', {}, h('kbd', {}, key)), h('td', {}, what))))),
    h('div', { class: 'row end' }, h('button', { onclick: () => dialog.close() }, 'Close')));
  document.body.append(dialog);
  dialog.showModal();
}

let page: Page | null = null;

function open(): void {
  page?.leave();
  const { path, revision, gas } = addressOf(location.hash);
  const isMission = /^missions\/[a-z][a-z0-9-]*$/.test(path);
  page = isMission ? new MissionPage(path, revision, gas)
    : path === 'new' ? newPage() : path === 'service' ? servicePage() : listPage();
  const name = isMission ? path.slice('missions/'.length) : path === 'new' ? 'new mission' : path;
  document.title = name === '' ? 'PlumeScout' : `${name} – PlumeScout`;
  fill(document.getElementById('top')!,
    h('a', { class: 'brand', href: '#/' }, 'PlumeScout'),
    h('nav', { class: 'crumbs', 'aria-label': 'Where you are' },
      h('a', { href: '#/' }, 'missions'), name === '' ? null : h('span', {}, `› ${name}`)),
    ...(page instanceof MissionPage ? page.head : []),
    h('span', { class: 'spring' }),
    h('a', { href: '#/service' }, 'Service'),
    h('button', { onclick: showKeys, 'aria-label': 'Keys' }, '?'),
    h('button', { onclick: toggleTheme, 'aria-label': 'Dark or light' }, '◐'));
  fill(document.getElementById('page')!, page.element);
}

document.addEventListener('keydown', (event) => {
  const target = event.target as HTMLElement;
  if (event.ctrlKey || event.metaKey || event.altKey || target.closest('input, select, textarea, dialog')) {
    return;
  }
  if (event.key === 'd') toggleTheme();
  else if (event.key === '?') showKeys();
  else if (page instanceof MissionPage && page.onKey(event.key, target)) event.preventDefault();
});

applyTheme(currentTheme());
window.addEventListener('hashchange', open);
open();
