// Conversion of points to one array of numbers: x, z, x, z, ... or x, y, z, x, y, z, ...

function flatArray(points, axes, words) {
  const names = axes.join(', ');
  const accepted = `${words} of numbers: [${names}, ${names}, ...], [[${names}], ...] or [{${names}}, ...], metres`;
  const reject = (what) => {
    throw new Error(`${what}, expected ${accepted}`);
  };
  const isList = Array.isArray(points) || (ArrayBuffer.isView(points) && !(points instanceof DataView));
  if (!isList) reject(`points is ${points === null || typeof points !== 'object' ? String(points) : 'an object'}`);
  const isFlat = typeof points[0] === 'number' || points.length === 0;
  if (isFlat) {
    if (points.length % axes.length !== 0) reject(`points has ${points.length} numbers`);
    for (let i = 0; i < points.length; ++i)
      if (typeof points[i] !== 'number') reject(`points[${i}] is ${String(points[i])}`);
    return Float64Array.from(points);
  }
  const flat = new Float64Array(axes.length * points.length);
  points.forEach((point, i) => {
    const numbers = Array.isArray(point) ? point : axes.map((axis) => point?.[axis]);
    axes.forEach((_, axis) => {
      if (typeof numbers[axis] !== 'number') reject(`points[${i}] is no ${words.slice(0, -1)} of numbers`);
      flat[axes.length * i + axis] = numbers[axis];
    });
  });
  return flat;
}

/** @returns {Float64Array} a copy, x and z of each point */
export const flatPoints = (points) => flatArray(points, ['x', 'z'], 'pairs');

/** @returns {Float64Array} a copy, x, y and z of each point */
export const flatWaterPoints = (points) => flatArray(points, ['x', 'y', 'z'], 'triples');
