// Settings as the part of an address behind its #, and back to the bit:
//
//   #sum=xr8l&sea=storm&light=golden-hour&windDirectionRad=30deg&paused=true&timeS=12.5
//
// Only what differs from a preset of sea and light is in it, and from the page's defaults. A number is written in the fewest digits that read
// back as the same double, an angle in degrees where that is shorter. `sum` tells a link that lost a piece on its way from a whole one;
// whoever writes a link by hand leaves it out.
import {allOptions, check, defaultSettings} from './options.js';

const radiansPerDegree = Math.PI / 180;

/** FNV-1a over the text, as four letters of base 36. */
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

/** The preset, or none, from which the settings differ in the fewest options. */
function nearestPreset(presets, group, settings, defaults) {
  const differences = start => Object.keys(start).filter(name => start[name] !== settings[name]).length;
  let best = {name: '', count: differences(Object.fromEntries(presets.length ? Object.keys(presets[0][group]).map(name => [name, defaults[name]]) : []))};
  for (const preset of presets) {
    const count = differences(preset[group]) + 1;  // its name is a word more
    if (count < best.count) best = {name: preset.name, count};
  }
  return best.name;
}

const kinds = tables => [['sea', tables.seaPresets], ['light', tables.lightPresets]];

/** The text behind the #. Empty for the defaults. */
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
 * The settings of a link.
 * Throws an Error whose message is one line if the link is damaged or says what is not accepted.
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

/** One line, however long and odd the text is. */
function shown(text) {
  const line = text.replace(/[^\x20-\x7e]/g, '?');
  return line.length > 40 ? `${line.slice(0, 40)}...` : line;
}
