// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A form for the options of a mission, made from the wire's own description of them.
import { ScalarType, fromJson } from '@bufbuild/protobuf';
import type { DescField, DescMessage, JsonObject } from '@bufbuild/protobuf';
import { h } from './dom.ts';
import { OPTION_HELP } from '@plumescout/client/option-help';
import { MissionOptionsSchema } from '@plumescout/client/wire';
import type { MissionOptions } from '@plumescout/client/wire';

type Field = { element: HTMLElement; read: () => unknown }; // undefined: the server's default
const DEFAULT = 'server’s default';

function labelled(field: DescField, input: HTMLElement): HTMLElement {
  const id = `o-${field.parent.name}-${field.name}`;
  input.id = id;
  return h('div', { class: 'field' },
    h('label', { for: id }, field.name.replaceAll('_', ' ')), input,
    h('small', {}, OPTION_HELP[`${field.parent.typeName}.${field.name}`] ?? ''));
}

function choice(field: DescField, values: [string, unknown][]): Field {
  const select = h('select', {}, h('option', { value: '' }, DEFAULT),
    ...values.map(([name], i) => h('option', { value: i }, name)));
  return {
    element: labelled(field, select),
    read: () => (select.value === '' ? undefined : values[Number(select.value)][1]),
  };
}

function text(field: DescField, number: boolean): Field {
  const input = h('input', { type: number ? 'number' : 'text', step: 'any', placeholder: DEFAULT });
  return {
    element: labelled(field, input),
    read: () => {
      if (!input.validity.valid) throw new Error(`${field.name} is no number`);
      if (input.value === '') return undefined;
      return number ? Number(input.value) : input.value;
    },
  };
}

// "1,2 3,4 5,6".
export function pointsOf(line: string, what: string): { xM: number; yM: number }[] {
  return line.trim().split(/\s+/).map((word) => {
    const [xM, yM, more] = word.split(',').map(Number);
    if (!Number.isFinite(xM) || !Number.isFinite(yM) || more !== undefined) {
      throw new Error(`${what}: “${word}” is not x,y in metres`);
    }
    return { xM, yM };
  });
}

function areas(field: DescField): Field {
  const area = h('textarea', { placeholder: '0,0 2,0 2,1 0,1', spellcheck: 'false' });
  const element = labelled(field, area);
  element.lastElementChild!.textContent += ' One area a line: its corners, x,y in metres.';
  return {
    element,
    read: () => {
      const lines = area.value.split('\n').filter((line) => line.trim() !== '');
      return lines.length === 0 ? undefined
        : lines.map((line) => ({ vertices: pointsOf(line, 'keep out') }));
    },
  };
}

function place(field: DescField): Field {
  const input = h('input', { placeholder: DEFAULT });
  const element = labelled(field, input);
  element.lastElementChild!.textContent += ' As x,y in metres.';
  return {
    element,
    read: () => (input.value.trim() === '' ? undefined : pointsOf(input.value, field.name)[0]),
  };
}

// Whether they look like files of map_server; `head`: the first characters of the image.
export function checkMapFiles(yaml: string, head: string): void {
  if (!/^image\s*:/m.test(yaml)) {
    throw new Error('the YAML file is not one of map_server: it names no image');
  }
  if (!head.startsWith('P5')) {
    throw new Error('the image is not a binary PGM (P5), as map_server writes it: save it as one');
  }
}

// A map_server map: its files are read when the form is.
function priorMap(field: DescField): Field {
  const yaml = h('input', { type: 'file', accept: '.yaml,.yml', 'aria-label': 'YAML file of a map' });
  const pgm = h('input', { type: 'file', accept: '.pgm', 'aria-label': 'PGM image of a map' });
  const both = h('div', { class: 'row' }, yaml, pgm);
  const element = labelled(field, both);
  element.lastElementChild!.textContent += ' A map of map_server: its YAML file and its PGM image.';
  return {
    element,
    read: async () => {
      const [description, image] = [yaml.files?.[0], pgm.files?.[0]];
      if (description === undefined && image === undefined) return undefined;
      if (description === undefined || image === undefined) {
        throw new Error('a known map needs both files, YAML and PGM');
      }
      const text = await description.text();
      let binary = '';
      for (const byte of new Uint8Array(await image.arrayBuffer())) binary += String.fromCharCode(byte);
      checkMapFiles(text, binary.slice(0, 2));
      return { files: { yaml: text, pgm: btoa(binary) } };
    },
  };
}

function group(message: DescMessage, title: string, help: string): Field {
  const fields = message.fields.flatMap((field): [string, Field][] => {
    const made = fieldOf(field);
    return made === null ? [] : [[field.jsonName, made]];
  });
  return {
    element: h('details', { class: 'group' }, h('summary', {}, title),
      h('div', {}, h('small', { class: 'quiet' }, help), ...fields.map(([, field]) => field.element))),
    read: async () => {
      const json: Record<string, unknown> = {};
      for (const [name, field] of fields) {
        const value = await field.read();
        if (value !== undefined) json[name] = value;
      }
      return Object.keys(json).length === 0 ? undefined : json;
    },
  };
}

function fieldOf(field: DescField): Field | null {
  if (field.fieldKind === 'enum') {
    const prefix = field.enum.sharedPrefix ?? '';
    return choice(field, field.enum.values.filter((value) => value.number !== 0).map((value) =>
      [value.name.toLowerCase().slice(prefix.length).replaceAll('_', ' '), value.name]));
  }
  if (field.fieldKind === 'scalar') {
    if (field.scalar === ScalarType.BOOL) return choice(field, [['yes', true], ['no', false]]);
    if (field.name === 'strategy') {
      return choice(field, ['plumescout', 'xit_gff', 'xit_fgf', 'xit_f', 'mit', 'rrt_star_frontier',
        'ipp_reward', 'lhr', 'random_sampling', 'sweep'].map((name) => [name, name]));
    }
    return text(field, field.scalar !== ScalarType.STRING);
  }
  if (field.fieldKind === 'list') return field.name === 'keep_out' ? areas(field) : null;
  if (field.fieldKind !== 'message') return null;
  switch (field.message.name) {
    case 'Point2D': return place(field);
    case 'PriorMap': return priorMap(field);
    default: return group(field.message, field.name.replaceAll('_', ' '),
                          OPTION_HELP[`${field.parent.typeName}.${field.name}`] ?? '');
  }
}

export function optionsForm(): { element: HTMLElement; read: () => Promise<MissionOptions> } {
  const whole = group(MissionOptionsSchema, 'Options', 'What is left empty is as the server has it.');
  return {
    element: whole.element,
    read: async () => fromJson(MissionOptionsSchema, (await whole.read() ?? {}) as JsonObject),
  };
}
