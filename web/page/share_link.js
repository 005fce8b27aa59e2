// Settings as the fragment of an address, and back without loss:
//
//   #sum=xr8l&sea=storm&light=golden-hour&windDirectionRad=30deg&paused=true&timeS=12.5
//
// A link has the nearest presets of sea and light, and the options that differ from them and from
// the page's defaults. Numbers have the fewest digits that give the same double; an angle is in
// degrees if that is shorter. The optional checksum `sum` detects damaged links.
import {allOptions, check, defaultSettings} from './options.js';

const radiansPerDegree = Math.PI / 180;

/** Returns the FNV-1a of a text, as four digits of base 36. */
function sumOf(text) {
  let hash = 0x811c9dc5;
  for (let i = 0; i < text.length; ++i) hash = Math.imul(hash ^ text.charCodeAt(i), 0x01000193) >>> 0;
  return (hash % 36 ** 4).toString(36).padStart(4, '0');
}

function numberText(option, value) {
  const plain = Object.is(value, -0) ? '-0' : String(value);
  if (!option.name.endsWith('Rad')) return plain;
  const degrees = `${Number((value / radiansPerDegree).toPrecision(12))}deg`;
  return degrees.length < plain.length && numberOf(degrees) === value ? degrees : plain;
}

function numberOf(text) {
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?(deg)?$/i.test(text)) return NaN;
  return text.endsWith('deg') ? Number(text.slice(0, -3)) * radiansPerDegree : Number(text);
}

function valueOf(option, text) {
  if (option.words) return text;
  if (typeof option.default === 'boolean') return text === 'true' ? true : text === 'false' ? false : text;
  const number = numberOf(text);
  if (Number.isNaN(number)) throw new Error(`${option.name} is ${text || 'empty'}, expected a number: ${option.accepted}`);
  return number;
}

/** Returns the name of the preset with the fewest different options, or ''. */
function nearestPreset(presets, group, settings, defaults) {
  const differences = start => Object.keys(start).filter(name => start[name] !== settings[name]).length;
  let best = {name: '', count: differences(Object.fromEntries(presets.length ? Object.keys(presets[0][group]).map(name => [name, defaults[name]]) : []))};
  for (const preset of presets) {
    const count = differences(preset[group]) + 1;  // counts the preset's name
    if (count < best.count) best = {name: preset.name, count};
  }
  return best.name;
}

const kinds = tables => [['sea', tables.seaPresets], ['light', tables.lightPresets]];

/** Returns the text after the #; empty for the defaults. */
export function writeLink(settings, tables) {
  const words = [];
  let start = defaultSettings(tables);
  const defaults = start;
  for (const [group, presets] of kinds(tables)) {
    const name = nearestPreset(presets, group, settings, defaults);
    if (!name) continue;
    words.push(`${group}=${name}`);
    start = {...start, ...presets.find(preset => preset.name === name)[group]};
  }
  for (const option of allOptions(tables)) {
    const value = settings[option.name];
    if (Object.is(value, start[option.name])) continue;
    words.push(`${option.name}=${typeof value === 'number' ? numberText(option, value) : value}`);
  }
  const text = words.join('&');
  return text && `sum=${sumOf(text)}&${text}`;
}

/**
 * Returns the settings of a link. Throws an Error of one line if the link is damaged or an option
 * is invalid.
 */
export function readLink(text, module, tables) {
  const words = text.replace(/^#/, '').split('&').filter(word => word);
  const sum = words[0]?.startsWith('sum=') ? words.shift().slice(4) : undefined;
  if (sum !== undefined && sum !== sumOf(words.join('&'))) throw new Error('a piece of the link is missing or was changed');
  const given = new Map();
  for (const word of words) {
    const [name, ...rest] = word.split('=');
    if (given.has(name)) throw new Error(`${shown(name)} stands twice in the link`);
    given.set(name, decoded(rest.join('=')));
  }
  let settings = defaultSettings(tables);
  for (const [group, presets] of kinds(tables)) {
    if (!given.has(group)) continue;
    const preset = presets.find(one => one.name === given.get(group));
    if (!preset) throw new Error(`${group} is ${shown(given.get(group))}, expected one of ${presets.map(one => one.name).join(', ')}`);
    settings = {...settings, ...preset[group]};
    given.delete(group);
  }
  const options = new Map(allOptions(tables).map(option => [option.name, option]));
  for (const [name, value] of given) {
    const option = options.get(name);
    if (!option) throw new Error(`the page has no option ${shown(name)}`);
    settings[name] = valueOf(option, shown(value));
  }
  const reason = check(settings, module, tables);
  if (reason) throw new Error(reason);
  return settings;
}

function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** Returns a text as one short line of printable characters. */
function shown(text) {
  const line = text.replace(/[^\x20-\x7e]/g, '?');
  return line.length > 40 ? `${line.slice(0, 40)}...` : line;
}
