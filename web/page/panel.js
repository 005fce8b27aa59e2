// The panel: the sliders of the native viewer, by the library's table, then all other options of
// the sea and the light.
import {allOptions} from './options.js';

const degrees = 180 / Math.PI;

function element(kind, properties = {}, ...children) {
  const made = Object.assign(document.createElement(kind), properties);
  made.append(...children);
  return made;
}

/** Returns a label: "fetch, m" for "fetchM". */
function labelOf(name) {
  const units = {Mps: 'm/s', Rad: 'deg', M: 'm', S: 's'};
  const unit = Object.keys(units).find(one => name.endsWith(one) && name.length > one.length);
  const bare = unit ? name.slice(0, -unit.length) : name;
  const words = bare.replace(/[A-Z]/g, letter => ` ${letter.toLowerCase()}`);
  return unit ? `${words}, ${units[unit]}` : words;
}

/** Returns a function that formats numbers by a text such as "%+.1f stops". */
function formatOf(text) {
  const [, plus, digits, unit] = text.match(/%(\+?)\.(\d)f ?(.*)/);
  return value => `${plus && value > 0 ? '+' : ''}${value.toFixed(digits)} ${unit.replace('deg', '°')}`.replace(' °', '°').trim();
}

export class Panel {
  /**
   * @param form    to be filled
   * @param change  called with the options that the user changed, by name
   */
  constructor(form, tables, change) {
    this.tables = tables;
    this.change = change;
    this.followers = [];  // functions that display settings
    this.options = new Map(allOptions(tables).map(option => [option.name, option]));
    const slid = [...tables.seaSliders, ...tables.lightSliders].map(slider => slider.option);
    const others = group => allOptions(tables).filter(option => option.group === group && !slid.includes(option.name));
    form.append(
      this.group('Sea', true,
        this.presetRow('sea state', tables.seaPresets, 'sea', ['cascades', 'resolution', 'patchSizeM']),
        ...tables.seaSliders.map(slider => this.sliderRow(slider)),
        this.group('More of the sea', false, ...others('sea').map(option => this.optionRow(option)))),
      this.group('Light', true,
        this.presetRow('light', tables.lightPresets, 'light', []),
        ...tables.lightSliders.map(slider => this.sliderRow(slider)),
        this.group('More of the light', false, ...others('light').map(option => this.optionRow(option)))),
      this.group('Image', innerWidth > 640,
        ...['quality', 'shading', 'scale', 'boat', 'cameraFlies'].map(name => this.optionRow(this.options.get(name)))),
      element('p', {className: 'hint', textContent: 'Camera: drag, wheel or pinch, arrows, W A S D R F. H hides this, space pauses.'}));
    form.addEventListener('submit', event => event.preventDefault());
  }

  /** Displays the settings. */
  show(settings) {
    for (const follow of this.followers) follow(settings);
  }

  group(title, isOpen, ...rows) {
    return element('details', {open: isOpen}, element('summary', {textContent: title}), ...rows);
  }

  row(kind, label, input, ...more) {
    input.id = `option-${label.replace(/\W+/g, '-')}`;
    return element('div', {className: `row ${kind}`}, element('label', {htmlFor: input.id, textContent: label}), input, ...more);
  }

  /** Makes a list of presets. A preset sets the options of its group, except the kept ones. */
  presetRow(label, presets, group, kept) {
    const select = element('select', {}, element('option', {value: '', textContent: 'own'}),
      ...presets.map(preset => element('option', {value: preset.name, textContent: preset.name, title: preset.summary})));
    const asPreset = preset => Object.fromEntries(Object.entries(preset[group]).filter(([name]) => !kept.includes(name)));
    select.addEventListener('change', () => {
      const preset = presets.find(one => one.name === select.value);
      if (preset) this.change(group === 'sea' && preset.sea.waves === 'pond' ? preset.sea : asPreset(preset));
    });
    this.followers.push(settings => {
      const is = preset => Object.entries(asPreset(preset)).every(([name, value]) => settings[name] === value);
      select.value = presets.find(is)?.name ?? '';
    });
    return this.row('wide', label, select);
  }

  sliderRow({label, option, least, most, format}) {
    const scale = option.endsWith('Rad') ? degrees : 1;
    const text = formatOf(format);
    const step = 10 ** -Number(format.match(/\.(\d)f/)[1]);
    const input = element('input', {type: 'range', min: least, max: most, step});
    const output = element('output');
    input.addEventListener('input', () => this.change({[option]: Number(input.value) / scale}));
    const row = this.row('', label, input, output);
    output.htmlFor = input.id;
    this.followers.push(settings => {
      // The default number of cascades is four. Two sliders apply to one kind of waves only.
      const value = option === 'cascades' && settings.cascades === 0 ? 4 : settings[option];
      input.value = value * scale;
      output.value = text(value * scale);
      row.hidden = (option === 'waveStrength' && settings.waves !== 'analytic') || (option === 'waveDrag' && settings.waves !== 'pond') ||
        (option === 'cascades' && settings.waves === 'pond');
    });
    return row;
  }

  optionRow(option) {
    const label = labelOf(option.name);
    if (option.words) {
      const select = element('select', {}, ...option.words.map(word => element('option', {value: word, textContent: word})));
      select.addEventListener('change', () => this.change({[option.name]: select.value}));
      this.followers.push(settings => { select.value = settings[option.name]; });
      return this.row('wide', label, select);
    }
    if (typeof option.default === 'boolean') {
      const box = element('input', {type: 'checkbox'});
      box.addEventListener('change', () => this.change({[option.name]: box.checked}));
      this.followers.push(settings => { box.checked = settings[option.name]; });
      return this.row('wide', label.replace('camera flies', 'fly'), box);
    }
    const scale = option.name.endsWith('Rad') ? degrees : 1;
    const input = element('input', {type: 'number', step: 'any', title: `accepts ${option.accepted}`});
    input.addEventListener('change', () => this.change({[option.name]: Number(input.value) / scale}));
    this.followers.push(settings => { if (document.activeElement !== input) input.value = Number((settings[option.name] * scale).toPrecision(7)); });
    return this.row('number', label, input);
  }
}
