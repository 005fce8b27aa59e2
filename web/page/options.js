// The table of the page's options, and settings: an object with a value for each option.
//
// An option is {name, group, default, accepted}, a number also has {least, most} and a word
// {words}. The groups sea and light have the library's tables and checks; the page adds the group
// view.

/** Returns the options of the page itself: camera, image, clock. */
function viewOptions(tables) {
  const number = (name, value, least, most, accepted = `[${least}, ${most}]`) =>
    ({name, group: 'view', default: value, least, most, accepted});
  const word = (name, value, words) => ({name, group: 'view', default: value, words, accepted: `one of ${words.join(', ')}`});
  const flag = (name, value) => ({name, group: 'view', default: value, accepted: 'true or false'});
  return [
    number('cameraXM', -17.4, -1e7, 1e7),
    number('cameraYM', 3.6, -50, 5000),
    number('cameraZM', 4.5, -1e7, 1e7),
    number('cameraHeadingRad', -0.18, -1e3, 1e3),
    number('cameraPitchRad', -0.09, -1.5, 1.5),
    number('cameraDistanceM', 18, 1, 3000),
    number('cameraFovRad', 0.9, 0.05, 2.8),
    flag('cameraFlies', false),
    word('quality', 'high', tables.qualities),
    word('shading', 'medium', tables.shadings),
    {...number('scale', 0, 0.25, 1, '[0.25, 1], or 0: by the frame time'), also: 0},
    flag('boat', true),
    flag('paused', false),
    number('timeS', 0, -1e9, 1e9),
  ];
}

/** Returns all options, in the order of the panel and of links. */
export function allOptions(tables) {
  return [
    ...tables.seaOptions.map(option => ({...option, group: 'sea'})),
    ...tables.lightOptions.map(option => ({...option, group: 'light'})),
    ...viewOptions(tables),
  ];
}

const pageLight = 'noon';

/** Returns the initial settings. */
export function defaultSettings(tables) {
  const settings = {};
  for (const option of allOptions(tables)) settings[option.name] = option.default;
  return {...settings, ...tables.lightPresets.find(preset => preset.name === pageLight).light};
}

/** Returns the settings of one group. */
export function groupOf(settings, tables, group) {
  const names = allOptions(tables).filter(option => option.group === group).map(option => option.name);
  return Object.fromEntries(names.map(name => [name, settings[name]]));
}

function checkView(option, value) {
  const isFit = option.words ? option.words.includes(value)
    : typeof option.default === 'boolean' ? typeof value === 'boolean'
    : Number.isFinite(value) && ((value >= option.least && value <= option.most) || value === option.also);
  if (isFit) return '';
  return /^[[(]/.test(option.accepted)
    ? `${option.name} ${value} is out of range ${option.accepted}`
    : `${option.name} is ${value}, expected ${option.accepted}`;
}

/** Returns '' for valid settings, else a line with the option, its value and what is accepted. */
export function check(settings, module, tables) {
  const sea = module.checkSea(groupOf(settings, tables, 'sea'));
  if (sea.error) return sea.error;
  const light = module.checkLight(groupOf(settings, tables, 'light'));
  if (light.error) return light.error;
  const views = allOptions(tables).filter(option => option.group === 'view');
  return views.map(option => checkView(option, settings[option.name])).find(reason => reason) ?? '';
}
